// SPDX-License-Identifier: GPL-3.0-or-later
// Editor panels: the plug-in's mixer, with a strip per actuator, then the total level and the limiter; the
// rules for notes and controllers; a keyboard that shows what each key is, and plays it.
#pragma once
#include "Host/Views/StripParts.h"
#include "MidiMap.h"
#include "PluginProcessor.h"
#include <functional>
#include <memory>
#include <vector>

namespace physvib {

/// What panels do with the state: apply an edit to it, or show the user a line if that is impossible.
struct MixHands {
    std::function<void(const std::function<void(PluginState&)>&)> edit;
    std::function<void(const juce::String&)> report;
};

/// M only.
class MixStrip final : public StripParts {
public:
    static constexpr int width = 80;

    MixStrip(const MixHands& hands, int strip, const juce::String& label);
    void take(const PluginState& state);
    void update(float peak, bool isConnected);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void change(const juce::String&, const std::function<void(Strip&)>& how) override;
    void askActuator();
    void chooseActuator(const std::string& nameOrPath);
    void equalise(bool on);

    const MixHands& hands_;
    const std::size_t index_;
    const juce::String label_;
    EnchanterDescription enchanter_;
    bool isSilent_ = false, isEqualised_ = false, isConnected_ = true;
    float hold_ = 0.0f;
    double holdUntilMs_ = 0.0;
    juce::TextButton actuator_;
    std::unique_ptr<juce::FileChooser> chooser_;
};

class MixPanel final : public juce::Component {
public:
    MixPanel(PluginProcessor& plugin, MixHands hands);
    void take(const PluginState& state);
    void update(const ChannelMeters& meters);
    int wishedWidth() const;      ///< in pixels, so that all strips are visible
    std::function<void()> onMenu; ///< a right click on the level
    void mouseDown(const juce::MouseEvent& e) override {
        if (e.eventComponent == &level_ && e.mods.isPopupMenu()) onMenu();
    }
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    const MixHands hands_;
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
juce::String wordsOf(const NoteRule& rule, const Scene& scene);
juce::String wordsOf(const ControllerRule& rule);

/// M only.
class MidiPanel final : public juce::Component, private juce::ListBoxModel {
public:
    explicit MidiPanel(MixHands hands);
    void take(const PluginState& state);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    bool isNote(int row) const { return row < static_cast<int>(state_.notes.size()); }
    int getNumRows() override { return static_cast<int>(state_.notes.size() + state_.controllers.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    std::pair<juce::String, juce::String> wordsOfRow(int row) const;
    juce::String getNameForRow(int row) override;
    void selectedRowsChanged(int) override { showChoice(); }
    void listBoxItemDoubleClicked(int row, const juce::MouseEvent&) override { change(row); }
    void returnKeyPressed(int row) override { change(row); }
    void deleteKeyPressed(int row) override { remove(row); }
    void showChoice();
    void change(int row);
    void remove(int row);
    juce::AlertWindow& newForm(const juce::String& title);
    void ask(std::function<void(juce::AlertWindow&)> use); ///< `use` gets the form filled in
    void askNote(int row, NoteRule rule);
    void askController(int row, ControllerRule rule);
    void keep(int row, const NoteRule& rule);
    void keep(int row, const ControllerRule& rule);

    const MixHands hands_;
    PluginState state_;
    juce::Label title_, hint_;
    juce::ListBox list_{"What notes and controllers do", this};
    juce::TextButton addNote_{"Add a note"}, addController_{"Add a controller"}, change_{"Change"},
        remove_{"Remove"};
    std::unique_ptr<juce::AlertWindow> form_; // the last: it is drawn by our look
};

/// What a key plays, as text for the user: "C4: 262 Hz at 0 %, 50 %, as long as it is held". Any thread.
juce::String wordsOfKey(int note, const MidiTable& table, const PluginState& state,
                        const NoteKnobs& knobs = {});

/// Five octaves. Keys with a rule of their own bear a mark; those that do nothing are dim. M only.
class KeyboardPanel final : public juce::Component, public juce::SettableTooltipClient {
public:
    static constexpr int height = 78;
    static constexpr int lowest = 36, highest = 96; ///< C2 to C7

    /// `play(note, velocity)`, 0: the key is let go.
    explicit KeyboardPanel(std::function<void(int, int)> play);
    void take(const PluginState& state, const NoteKnobs& knobs);

    /// The note of a place; -1: none. The lower on a key, the harder.
    int noteAt(juce::Point<int> place) const;
    int velocityAt(juce::Point<int> place) const;

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override { press(e.getPosition()); }
    void mouseDrag(const juce::MouseEvent& e) override { press(e.getPosition()); }
    void mouseUp(const juce::MouseEvent&) override { letGo(); }
    void mouseMove(const juce::MouseEvent& e) override { show(noteAt(e.getPosition())); }
    void mouseExit(const juce::MouseEvent&) override { show(-1); }

private:
    juce::Rectangle<float> boundsOf(int note) const;
    void press(juce::Point<int> place);
    void letGo();
    void show(int note);
    void paintKey(juce::Graphics& g, int note) const;

    const std::function<void(int, int)> play_;
    PluginState state_;
    MidiTable table_;
    NoteKnobs knobs_;
    int pressed_ = -1, shown_ = -1;
};

} // namespace physvib
