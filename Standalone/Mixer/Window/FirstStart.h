// SPDX-License-Identifier: GPL-3.0-or-later
// First-start assistant: chooses the device of the actuators, then tests each actuator: was its pulse felt,
// and where?
#pragma once
#include "Mixer/Widgets/Cards.h"
#include <string_view>

namespace physvib {

/// A device choice that can play vibration.
struct FeltChoice {
    juce::String title;
    DeviceChoice device;
    int outputs = 0;
    bool isBeside = false; ///< a sink, used instead of an audio device; choosing it restarts the session
    bool isHeard = false;  ///< headphones: vibration is heard on the first two outputs, not felt
};

/// An available sink.
struct SinkOffer {
    const SinkKind* kind;
    SinkPlace place;
};

/// All available sinks that can be detected. Message thread. Slow, as it queries the system.
std::vector<SinkOffer> likelySinks();

/// Choices of audio devices, sinks, and no device, the most likely one first. Message thread. As slow as
/// likelySinks().
std::vector<FeltChoice> feltChoices(const AudioDrivers& drivers, const std::vector<SinkOffer>& offers);

/// Card over the window, usable by keys alone: up, down and Return; then Return (felt), L (louder), N (not
/// felt); Esc ends it, too. Message thread.
class FirstStart final : public Card, private juce::Timer {
public:
    static constexpr int wide = 600;
    static constexpr double firstDb = -24.0, mostDb = -6.0, louderDb = 6.0;

    FirstStart(MixerModel& model, std::vector<FeltChoice> choices);

    std::function<void(bool hasChosen)> onEnd;
    /// A sink was chosen: the window opens it, then calls test().
    std::function<void(const DeviceChoice&)> onSink;

    void choose(int index);
    int chosen() const noexcept { return chosen_; }
    void playHere();        ///< opens the chosen device and starts the test
    void test(int outputs); ///< tests an actuator per output, in turn, from a low level; waits for sinks
    void pulse();           ///< repeats the pulse of the tested actuator
    void felt() { next(); } ///< the pulse was felt where the actuator is drawn; tests the next
    void feltAt(double shareX, double shareY); ///< moves the actuator there; tests the next
    void notFelt();                            ///< takes the output from the actuator; tests the next
    void louder();
    int tested() const noexcept { return tested_; } ///< number of the actuator; -1: none
    void end(bool hasChosen);

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override;

private:
    void timerCallback() override;
    bool isGone() const;
    bool isPlayed() const;
    void next();
    void show();
    int contentHigh() const override;
    void place(juce::Rectangle<int> content) override;

    MixerModel& model_;
    std::vector<FeltChoice> choices_;
    std::vector<std::unique_ptr<juce::Button>> rows_;
    juce::Rectangle<int> field_; // of the test
    juce::TextButton play_{"Play here"}, without_{"Without a device"}, felt_{"Felt"}, louder_{"Louder"},
        notFelt_{"Not felt"}, done_{"Done"};
    int chosen_ = 0, tested_ = -1, slowness_ = 1, looks_ = 0;
};

} // namespace physvib
