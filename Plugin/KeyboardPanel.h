// SPDX-License-Identifier: GPL-3.0-or-later
// A keyboard that shows what each key is, and plays it.
#pragma once
#include "MidiMap.h"
#include "MixPanel.h"
#include <functional>

namespace physvib {

/// What a key does, for people: "C4: 262 Hz at 0 %, 50 %, as long as it is held". Any thread.
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
