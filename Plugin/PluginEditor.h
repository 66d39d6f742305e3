// SPDX-License-Identifier: GPL-3.0-or-later
// The plug-in's window: the world, the mixer, settings, a control per parameter, and error messages.
#pragma once
#include "EditorPanels.h"
#include "Host/Views/EmergencyStop.h"
#include "Host/Views/WorldView.h"
#include "HostKeys.h"
#include "PluginProcessor.h"
#include <memory>
#include <vector>

namespace physvib {

/// A knob, or a list of words, of one parameter, with its name.
class ParameterControl final : public juce::Component {
public:
    explicit ParameterControl(HostParameter& parameter);
    void rename(int choice, const juce::String& words); ///< of a list, from 0
    std::function<void(ParameterControl&)> onMenu;      ///< a right click, anywhere on it
    void type();                                        ///< opens the box of a knob's value
    void mouseDown(const juce::MouseEvent& e) override;
    void resized() override;
    void lookAndFeelChanged() override;
    bool isList() const noexcept { return listAttachment_ != nullptr; }
    int shares() const noexcept { return isList() ? 3 : 2; } ///< of the width
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

    /// Plays a file of one's own: a preset, a scene, a layout, or a saved session.
    void open(const juce::File& file);
    void showMidi(bool on);
    void setTheme(Theme theme);

    /// The next controller that comes in will move that parameter.
    void learn(Parameter which);
    void go(PluginProcessor::Step step); ///< undo, redo, the other one of A and B
    /// What this instance is, as a preset; what was felt, by the ending of the file's name.
    void savePresetAs(const juce::File& file);
    void exportFeltAs(const juce::File& file);

    void paint(juce::Graphics& g) override;
    void resized() override;
    bool keyPressed(const juce::KeyPress& key) override; ///< that no control has used
    bool keyPressed(const juce::KeyPress& key, juce::Component*) override { return keyPressed(key); }
    bool isInterestedInFileDrag(const juce::StringArray& files) override {
        return files.size() == 1 && files[0].endsWithIgnoreCase(".json");
    }
    void filesDropped(const juce::StringArray& files, int, int) override { open(juce::File{files[0]}); }

    /// One picture of what is going on; the timer calls it, at most 25 times a second.
    void refresh();
    juce::String statusText() const { return status_.getText(); }
    /// What the lower edge says while the mouse is over that component: its help, or that of what it is in.
    juce::String helpOf(juce::Component* underMouse) const;

private:
    static constexpr int firstOwnPreset = 10'000; // ids of the list
    struct Group {                                // of parameters, side by side on a ground of their own
        std::string_view name;
        std::vector<std::unique_ptr<ParameterControl>> controls;
        juce::Rectangle<int> place{};
        bool isShown() const {
            return std::ranges::any_of(controls, [](const auto& one) { return one->isVisible(); });
        }
        /// Those that are shown, from left to right; lists that are neighbours stand one above the other.
        using Column = std::vector<ParameterControl*>;
        std::vector<Column> columns() const;
    };
    void timerCallback() override { refresh(); }
    void stateChanged();
    void readKnobs();
    juce::String latencyText() const;
    juce::String outputText(const ChannelMeters& meters) const;
    void fillGroups();
    void placeGroups(juce::Rectangle<int> controls);
    void showHint(const juce::String& text);
    void fillChoices();
    void nameMaterials();
    void showFiles();
    void showMenu(HostParameter& parameter, const std::function<void()>& type = {});
    void followLearning();
    static bool closesFirst();
    void listenAround();
    juce::TextEditor* openBox() const; // in which a value is typed; null: none
    void fillPresets();
    void edit(const std::function<void(PluginState&)>& change);
    void report(const juce::String& news) { news_ = news; }
    MixHands hands(bool areChecked);
    juce::String statusLine(const TakesStatus& status, const ChannelMeters& meters) const;

    PluginProcessor& plugin_;
    Look look_;
    Tips tooltips_{*this};
    juce::Label title_, status_, seedName_, stepsName_, firstSteps_;
    juce::ComboBox scene_, layout_, steps_;
    juce::TextEditor seed_;
    juce::TextButton restart_{"Restart on play"}, files_, midi_{"MIDI"}, silence_{"SILENCE"},
        direct_{"Direct"}, tempo_{"Tempo"}, fold_;
    juce::ButtonParameterAttachment silenceAttachment_;
    WorldView world_;
    HostKeys host_;
    juce::Component::SafePointer<juce::Component> around_;
    MidiPanel midiPanel_;
    MixPanel mix_;
    KeyboardPanel keys_;
    std::vector<Group> groups_;
    std::vector<ParameterControl*> materials_;       // lists of materials
    NoteKnobs knobs_;                                // as they are shown
    std::uint64_t aheadShown_ = 0, aheadBefore_ = 0; // blocks that the host waited for, at two pictures
    std::unique_ptr<juce::FileChooser> chooser_;
    std::vector<juce::File> presets_; // one's own, as they are listed
    int learning_ = -1;               // a parameter; -1: none
    std::uint32_t learnsAfter_ = 0;   // what the processor's lastController() was
    juce::String news_;               // of what was opened or asked for; until the next edit
    std::uint64_t shown_ = 0;         // the processor's count of states
    PluginState state_;
    // Only the button lifts: a host may close this window by the same Esc. It is no parameter's, or a track
    // would be silent in the next session.
    EmergencyStop stop_{*this, [this] { plugin_.stop(true); }, closesFirst};
};

} // namespace physvib
