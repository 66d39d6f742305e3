// SPDX-License-Identifier: GPL-3.0-or-later
// The first start: where the actuators hang, then each of them in turn: was it felt, and where?
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/Parts.h"
#include <functional>
#include <memory>
#include <vector>

namespace physvib {

/// Something that can be felt.
struct FeltChoice {
    juce::String title;
    DeviceChoice device;
    int outputs = 0;
    bool isBeside = false; ///< a sink: the session begins anew with it
    bool isHeard = false;  ///< on headphones at its first two outputs; no actuator plays there
};

/// Something that can be played on beside a device.
struct SinkOffer {
    const SinkKind* kind;
    SinkPlace place;
};

/// All that can be told to be one. M; asks the system, which takes a while.
std::vector<SinkOffer> likelySinks();

/// Audio devices, what can be played on beside one, and no device; the likely one first. M; as likelySinks().
std::vector<FeltChoice> feltChoices(const AudioDeviceTypes& types, const std::vector<SinkOffer>& offers);

/// No more actuators than there are outputs: those of a preset. M.
void keepTo(int outputs, Mix& mix);

/// A card over the window. All is done by keys as well: up, down and Return; then Return (felt), L (louder),
/// N (not felt). M only.
class FirstStart final : public juce::Component, private juce::Timer {
public:
    static constexpr int wide = 600, high = 400;
    static constexpr double firstDb = -24.0, mostDb = -6.0, louderDb = 6.0;

    FirstStart(Desk& desk, std::vector<FeltChoice> choices);

    std::function<void(bool hasChosen)> onEnd;
    std::function<void(const DeviceChoice&)> onBeside; ///< the window plays a sink beside a device, and goes
                                                       ///< on with test()

    void choose(int index);
    int chosen() const noexcept { return chosen_; }
    void playHere();        ///< what is chosen: opens it, and the test begins
    void listen();          ///< what is felt is heard on what is open
    void test(int outputs); ///< of as many actuators as there are outputs, four at most, from a low level; a
                            ///< sink is waited for
    void pulse();           ///< of the one that is tested, again
    void felt();            ///< where it is drawn; the next one
    void feltAt(double shareX, double shareY); ///< there: it moves, and the next one
    void notFelt();                            ///< takes its output away; the next one
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

    Desk& desk_;
    std::vector<FeltChoice> choices_;
    std::vector<std::unique_ptr<juce::TextButton>> rows_;
    juce::Label title_, words_;
    juce::TextButton play_{"Play here"}, without_{"Without a device"}, felt_{"Felt"}, louder_{"Louder"},
        notFelt_{"Not felt"}, done_{"Done"};
    int chosen_ = 0, tested_ = -1, slowness_ = 1, looks_ = 0;
};

} // namespace physvib
