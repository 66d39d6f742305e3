// SPDX-License-Identifier: GPL-3.0-or-later
// PluginEditor: the plug-in's window; ParameterControl: the knob or list of one parameter. M only.
#pragma once
#include "EditorPanels.h"
#include "Host/Views/EmergencyStop.h"
#include "Host/Views/WorldView.h"
#include "HostKeys.h"
#include "PluginProcessor.h"
#include <memory>
#include <vector>

namespace physvib {

/// The knob of one parameter, or the list of its choices, with its name.
class ParameterControl final : public juce::Component {
public:
    explicit ParameterControl(HostParameter& parameter);
    void rename(int choice, const juce::String& words); ///< sets the text of a list's choice, from 0
    std::function<void(ParameterControl&)> onMenu;      ///< a right click, anywhere on it
    void editValue();                                   ///< opens the box of a knob's value
    void mouseDown(const juce::MouseEvent& e) override;
    void resized() override;
    void lookAndFeelChanged() override;
    bool isList() const noexcept { return listAttachment_ != nullptr; }
    int widthShares() const noexcept { return isList() ? 3 : 2; } ///< relative width
    HostParameter& parameter() const noexcept { return parameter_; }
    Parameter which() const noexcept { return parameter_.row().parameter; }

private:
    HostParameter& parameter_;
    juce::Label name_;
    juce::Slider knob_;
    juce::ComboBox list_;
    std::unique_ptr<juce::SliderParameterAttachment> knobAttachment_;
    std::unique_ptr<juce::ParameterAttachment> listAttachment_;
};

class PluginEditor final : public juce::AudioProcessorEditor,
                           public juce::FileDragAndDropTarget,
                           private juce::KeyListener,
                           private juce::Timer {
public:
    explicit PluginEditor(PluginProcessor& plugin);
    ~PluginEditor() override;

    /// Opens a file of the user: a preset, a scene, a layout, or a saved session.
    void open(const juce::File& file);
    void showMidi(bool on);
    void setTheme(Theme theme);

    /// Makes the next controller received move that parameter.
    void learn(Parameter which);
    void stepHistory(PluginProcessor::Direction direction); ///< undo, redo, or exchange of A and B
    juce::PopupMenu makeFilesMenu();
    /// The host's menu for this parameter with our entries after it.
    juce::PopupMenu makeMenu(HostParameter& parameter, const std::function<void()>& editValue = {});
    /// Save the state as a preset, and the played events in the format that the file's name ends with.
    void savePresetAs(const juce::File& file);
    void exportPlayedAs(const juce::File& file);

    void paint(juce::Graphics& g) override;
    void resized() override;
    bool keyPressed(const juce::KeyPress& key) override; ///< gets the keys that no control used
    bool keyPressed(const juce::KeyPress& key, juce::Component*) override { return keyPressed(key); }
    bool isInterestedInFileDrag(const juce::StringArray& files) override {
        return files.size() == 1 && files[0].endsWithIgnoreCase(".json");
    }
    void filesDropped(const juce::StringArray& files, int, int) override { open(juce::File{files[0]}); }

    /// Updates the window from the processor; the timer calls it 25 times a second at most.
    void refresh();
    juce::String statusText() const { return status_.getText(); }
    /// Help for the status line: that of the component under the mouse, or of its nearest parent that has
    /// one.
    juce::String findHelp(juce::Component* underMouse) const;

private:
    static constexpr int firstUserPreset = 10'000; // id in the list of presets
    struct Group {                                 // controls of related parameters on one panel
        std::string_view name;
        std::vector<std::unique_ptr<ParameterControl>> controls;
        juce::Rectangle<int> bounds{};
        bool isShown() const {
            return std::ranges::any_of(controls, [](const auto& control) { return control->isVisible(); });
        }
        /// The visible controls from left to right; of two adjacent lists the second is below the first.
        using Column = std::vector<ParameterControl*>;
        std::vector<Column> columns() const;
    };
    void timerCallback() override { refresh(); }
    void stateChanged();
    void refreshControls();
    juce::String seedText() const { return juce::String{static_cast<juce::int64>(state_.seed)}; }
    juce::String latencyText() const;
    juce::String outputText(const ChannelMeters& meters) const;
    void addParameterControls();
    void placeGroups(juce::Rectangle<int> controls);
    void showHint(const juce::String& text);
    void setUpControls();
    void updateMaterialNames();
    void showMenu(juce::PopupMenu menu, juce::Component* below = nullptr); ///< null: at the mouse
    void finishLearning();
    static bool hasOpenPopup();
    void listenToHostWindow();
    juce::TextEditor* openValueBox() const; // box in which the user types a value; null: none
    void fillPresets();
    void edit(const std::function<void(PluginState&)>& change);
    void report(const juce::String& message) { message_ = message; }
    EditorActions editorActions(bool areChecked);
    juce::String statusLine(const RunsStatus& status, const ChannelMeters& meters) const;

    PluginProcessor& plugin_;
    Look look_;
    TooltipHost tooltips_{*this};
    juce::Label title_, status_, seedName_, stepsName_, hintLabel_;
    juce::ComboBox scene_, layout_, steps_;
    juce::TextEditor seed_;
    juce::TextButton restart_{"Restart on play"}, files_, midi_{"MIDI"}, silence_{"SILENCE"},
        direct_{"Direct"}, tempo_{"Tempo"}, fitOutputs_;
    juce::ButtonParameterAttachment silenceAttachment_;
    WorldView world_;
    HostKeys hostKeys_;
    juce::Component::SafePointer<juce::Component> hostWindow_;
    MidiPanel midiPanel_;
    MixPanel mix_;
    KeyboardPanel keys_;
    std::vector<Group> groups_;
    std::vector<ParameterControl*> materialLists_;                // lists of materials
    NoteKnobs shownKnobs_;                                        // the knobs as the window shows them
    std::uint64_t steppedBlocks_ = 0, previousSteppedBlocks_ = 0; // RunsStatus::blocksSteppedInRender
    std::unique_ptr<juce::FileChooser> chooser_;
    std::vector<juce::File> presets_;            // the user's, as they are listed
    int learningParameter_ = -1;                 // a parameter; -1: none
    std::uint32_t controllerBeforeLearning_ = 0; // lastController() when learning began
    juce::String message_;                       // shown until the next edit
    std::uint64_t shownStateVersion_ = 0;        // the processor's count of states
    PluginState state_;
    // Esc stops; only the button resumes, as a host may close this window by the same key. It sets no
    // parameter, or the track would still be silent in the next session.
    EmergencyStop stop_{*this, [this] { plugin_.setStopped(true); }, hasOpenPopup};
};

} // namespace physvib
