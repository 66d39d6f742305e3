// SPDX-License-Identifier: GPL-3.0-or-later
// Panels of the plug-in's window: MixPanel with a MixStrip per actuator, level and limiter; MidiPanel, the
// rules for notes and controllers; KeyboardPanel, which describes each key and plays it.
#pragma once
#include "Host/Views/StripParts.h"
#include "MidiMap.h"
#include "PluginProcessor.h"
#include "Scene/ActuatorFile.h"
#include <functional>
#include <memory>
#include <vector>

namespace physvib {

/// Callbacks of the panels: `edit` applies a change to the state, `report` shows a line to the user.
struct EditorActions {
    std::function<void(const std::function<void(PluginState&)>&)> edit;
    std::function<void(const juce::String&)> report;
};

/// The strip of one actuator: its profile, meter, fader and ceiling. M only.
class MixStrip final : public StripParts {
public:
    static constexpr int width = 80;

    MixStrip(const EditorActions& actions, int strip, const juce::String& label);
    void showState(const PluginState& state);
    void update(float peak, bool isConnected);
    juce::PopupMenu makeActuatorMenu();
    void chooseActuator(const std::string& nameOrPath);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void change(const juce::String&, const std::function<void(Strip&)>& edit) override;
    Result<ActuatorProfile> profile() const;
    void equalise(bool on);

    const EditorActions& actions_;
    const std::size_t index_;
    const juce::String label_;
    ActuatorDescription details_;
    ActuatorProfile chosen_; // also from a file, of which the state has the name only
    bool isSilent_ = false, isEqualised_ = false, isConnected_ = true;
    float peakHold_ = 0.0f;
    double holdUntilMs_ = 0.0;
    juce::TextButton actuator_;
    std::unique_ptr<juce::FileChooser> chooser_;
};

class MixPanel final : public juce::Component {
public:
    MixPanel(PluginProcessor& plugin, EditorActions actions);
    void showState(const PluginState& state);
    void update(const ChannelMeters& meters);
    int preferredWidth() const;   ///< in pixels, so that all strips are visible
    std::function<void()> onMenu; ///< a right click on the level
    void mouseDown(const juce::MouseEvent& e) override {
        if (e.eventComponent == &level_ && e.mods.isPopupMenu()) onMenu();
    }
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    const EditorActions actions_;
    juce::Viewport viewport_;
    juce::Component row_;
    std::vector<std::unique_ptr<MixStrip>> strips_;
    juce::StringArray labels_;
    Fader level_;
    juce::SliderParameterAttachment levelAttachment_;
    juce::TextButton limiter_{"Limiter"};
    LimiterBar limiterBar_;
    juce::Rectangle<int> levelName_, levelValue_, limiterValue_;
};

/// The rule as text for the user: "C4 strikes wood at 50 %, 0 %". Any thread.
juce::String describe(const NoteRule& rule, const Scene& scene);
juce::String describe(const ControllerRule& rule);

/// The list of rules for notes and controllers, with forms to edit them. M only.
class MidiPanel final : public juce::Component, private juce::ListBoxModel {
public:
    explicit MidiPanel(EditorActions actions);
    void showState(const PluginState& state);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    bool isNoteRow(int row) const { return row < static_cast<int>(state_.notes.size()); }
    const NoteRule& noteIn(int row) const { return state_.notes[static_cast<std::size_t>(row)]; }
    const ControllerRule& controllerIn(int row) const {
        return state_.controllers[static_cast<std::size_t>(row) - state_.notes.size()];
    }
    int getNumRows() override { return static_cast<int>(state_.notes.size() + state_.controllers.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    std::pair<juce::String, juce::String> describeRow(int row) const;
    juce::String getNameForRow(int row) override;
    void selectedRowsChanged(int) override { updateButtons(); }
    void listBoxItemDoubleClicked(int row, const juce::MouseEvent&) override { change(row); }
    void returnKeyPressed(int row) override { change(row); }
    void deleteKeyPressed(int row) override { remove(row); }
    void updateButtons();
    void change(int row);
    void remove(int row);
    juce::AlertWindow& newForm(const juce::String& title);
    void showForm(std::function<void(juce::AlertWindow&)> onAccept); ///< `onAccept` gets the form filled in
    // `replaced`: the note or controller whose rule is edited, -1: none
    void showNoteForm(int replaced, NoteRule rule);
    void showControllerForm(int replaced, ControllerRule rule);
    void storeRule(int replaced, const NoteRule& rule);
    void storeRule(int replaced, const ControllerRule& rule);

    const EditorActions actions_;
    PluginState state_;
    juce::Label title_, hint_;
    juce::ListBox list_{"What notes and controllers do", this};
    juce::TextButton addNote_{"Add a note"}, addController_{"Add a controller"}, change_{"Change"},
        remove_{"Remove"};
    std::unique_ptr<juce::AlertWindow> form_; // declared last: it uses our look and feel
};

/// What a key plays, as text for the user: "C4: 262 Hz at 0 %, 50 %, as long as it is held". Any thread.
juce::String describeKey(int note, const MidiTable& table, const PluginState& state,
                         const NoteKnobs& knobs = {});

/// A keyboard of five octaves. Keys with a rule of their own have a mark; those that do nothing are dim. M.
class KeyboardPanel final : public juce::Component, public juce::SettableTooltipClient {
public:
    static constexpr int height = 78;
    static constexpr int lowestNote = 36, highestNote = 96; ///< C2 to C7

    /// Calls `play(note, velocity)` when a key is pressed; velocity 0: it was released.
    explicit KeyboardPanel(std::function<void(int, int)> play);
    ~KeyboardPanel() override { releaseKey(); } ///< a host may close the window while a key is pressed
    void showState(const PluginState& state, const NoteKnobs& knobs);

    /// The note at a point of the component, -1: none; and its velocity, 1 to 127, higher further down.
    int noteAt(juce::Point<int> place) const;
    int velocityAt(juce::Point<int> place) const;

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override { press(e.getPosition()); }
    void mouseDrag(const juce::MouseEvent& e) override { press(e.getPosition()); }
    void mouseUp(const juce::MouseEvent&) override { releaseKey(); }
    void mouseMove(const juce::MouseEvent& e) override { showNote(noteAt(e.getPosition())); }
    void mouseExit(const juce::MouseEvent&) override { showNote(-1); }

private:
    juce::Rectangle<float> keyArea(int note) const;
    void press(juce::Point<int> place);
    void releaseKey();
    void showNote(int note);
    void paintKey(juce::Graphics& g, int note) const;

    const std::function<void(int, int)> play_;
    PluginState state_;
    MidiTable table_;
    NoteKnobs knobs_;
    int pressedNote_ = -1, hoveredNote_ = -1;
};

} // namespace physvib
