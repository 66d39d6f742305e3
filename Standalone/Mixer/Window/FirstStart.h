// SPDX-License-Identifier: GPL-3.0-or-later
// First-start assistant: the user chooses the device of the actuators (PlaybackChoice), then tests each
// actuator: was its pulse felt, and where?
#pragma once
#include "Mixer/Widgets/Cards.h"

namespace physvib {

/// A device choice that can play vibration.
struct PlaybackChoice {
    juce::String title;
    DeviceChoice device;
    int outputs = 0;
    bool isSink = false;       ///< a sink, used instead of an audio device; choosing it restarts the session
    bool isHeadphones = false; ///< headphones: vibration is heard on the first two outputs, not felt
};

/// An available sink.
struct DetectedSink {
    const SinkKind* kind;
    SinkUnit unit;
};

/// All sinks that are detected in the system. Message thread. Slow, as it queries the system.
std::vector<DetectedSink> detectSinks();

/// Choices of audio devices, sinks, and no device, the most likely first. Message thread. As slow as
/// detectSinks().
std::vector<PlaybackChoice> playbackChoices(const AudioDrivers& drivers,
                                            const std::vector<DetectedSink>& sinks);

/// Card over the window, usable by keys alone: up, down and Return; then Return (felt), L (louder), N (not
/// felt); Esc ends it, too. Message thread.
class FirstStart final : public Card, private juce::Timer {
public:
    static constexpr int cardWidth = 600;
    static constexpr double startDb = -24.0, maxDb = -6.0, stepDb = 6.0;

    FirstStart(MixerModel& model, std::vector<PlaybackChoice> choices);

    std::function<void(bool hasChosen)> onEnd;
    /// The user chose a sink: the window opens it, then calls test().
    std::function<void(const DeviceChoice&)> onSink;

    void choose(int index);
    void openChosen();      ///< opens the chosen device and starts the test
    void test(int outputs); ///< tests an actuator per output, in turn, from a low level; waits for sinks
    void pulse();           ///< repeats the pulse of the tested actuator
    void confirmPulse() { testNext(); } ///< the pulse was felt where the actuator is drawn; tests the next
    void confirmPulseAt(double shareX, double shareY); ///< moves the actuator there; tests the next
    void denyPulse();                                  ///< takes the output from the actuator; tests the next
    void raiseLevel();
    int tested() const noexcept { return testIndex_; } ///< number of the actuator; -1: none
    void end(bool hasChosen);

    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override;

private:
    void timerCallback() override;
    bool isDetached() const;
    bool areSinksReady() const;
    void testNext();
    void updateTexts();
    int contentHeight() const override;
    void placeContent(juce::Rectangle<int> content) override;

    MixerModel& model_;
    std::vector<PlaybackChoice> choices_;
    std::vector<std::unique_ptr<juce::Button>> rows_;
    juce::Rectangle<int> field_; // where the actuators are drawn in the test
    juce::TextButton playButton_{"Play here"}, noDeviceButton_{"Without a device"}, feltButton_{"Felt"},
        louderButton_{"Louder"}, notFeltButton_{"Not felt"}, doneButton_{"Done"};
    int chosenIndex_ = 0, testIndex_ = -1, slownessBefore_ = 1, readyCheckCount_ = 0;
};

} // namespace physvib
