// SPDX-License-Identifier: GPL-3.0-or-later
// First-start assistant: chooses the device of the actuators, then tests each actuator: was its pulse felt,
// and where?
#pragma once
#include "Mixer/Model/MixerModel.h"
#include "Mixer/Widgets/Parts.h"
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace physvib {

/// A device choice that can play vibration.
struct FeltChoice {
    juce::String title;
    DeviceChoice device;
    int outputs = 0;
    bool isBeside = false; ///< a sink; choosing it restarts the session
    bool isHeard = false;  ///< headphones on the first two outputs, without actuators
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

/// Reduces the layout to a preset with at most that number of actuators; a Pico gets its own one. Message
/// thread.
void keepTo(int outputs, Mix& mix, std::string_view device = {});

/// Card over the window, usable by keys alone: up, down and Return; then Return (felt), L (louder), N (not
/// felt). Message thread only.
class FirstStart final : public juce::Component, private juce::Timer {
public:
    static constexpr int wide = 600, high = 400;
    static constexpr double firstDb = -24.0, mostDb = -6.0, louderDb = 6.0;

    FirstStart(MixerModel& model, std::vector<FeltChoice> choices);

    std::function<void(bool hasChosen)> onEnd;
    std::function<void(const DeviceChoice&)> onBeside; ///< the window opens the sink, and continues with
                                                       ///< test()

    void choose(int index);
    int chosen() const noexcept { return chosen_; }
    void playHere();        ///< opens the chosen device and starts the test
    void test(int outputs); ///< tests an actuator per output, four at most, from a low level; waits for sinks
    void pulse();           ///< repeats the pulse of the tested actuator
    void felt();            ///< at its drawn place; goes on to the next
    void feltAt(double shareX, double shareY); ///< moves the actuator there; goes on to the next
    void notFelt();                            ///< removes its output; goes on to the next
    void louder();
    int tested() const noexcept { return tested_; } ///< -1: none
    void end(bool hasChosen);

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void resized() override;

private:
    void timerCallback() override;
    bool isGone() const;
    bool isPlayed() const;
    void next();
    void show();
    juce::Rectangle<int> field() const;

    MixerModel& model_;
    std::vector<FeltChoice> choices_;
    std::vector<std::unique_ptr<juce::TextButton>> rows_;
    juce::Label title_, words_;
    juce::TextButton play_{"Play here"}, without_{"Without a device"}, felt_{"Felt"}, louder_{"Louder"},
        notFelt_{"Not felt"}, done_{"Done"};
    int chosen_ = 0, tested_ = -1, slowness_ = 1, looks_ = 0;
};

} // namespace physvib
