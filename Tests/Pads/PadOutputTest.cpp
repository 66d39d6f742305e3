// SPDX-License-Identifier: MIT
// A session on controllers that SDL makes up: what their motors are told is the model, to the command.
#include "Live/Pads/PadOutput.h"
#include "Pads/VirtualPad.h"
#include "Support/FileTesting.h"
#include <future>
#include <gtest/gtest.h>

namespace physvib::pad_output_test {

using namespace pads_testing;

const std::function<bool()> always = [] { return true; };

class Pads : public testing::Test {
protected:
    GamePads pads{}; // before any virtual one
};

/// A controller, and a sink on it that is ready and follows a device.
class OnePad : public Pads {
protected:
    void SetUp() override {
        ASSERT_EQ(output.awaitReady(always), "");
        device.block();
        output.follow(&device);
    }
    VirtualPad pad{"one"};
    PacedDevice device;
    PadOutput output{"one@pad-generic", phone()}; // before the device it ends
};

class OnePadInRealTime : public OnePad {};

TEST_F(OnePadInRealTime, WhatTheMotorsAreToldIsTheModelToTheCommand) {
    EXPECT_DOUBLE_EQ(output.latencySeconds(), 0.03);
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 12; ++i)
        events.push_back(hit((200 + 90 * i) * ms, i % 2 ? 50.0 : 220.0, 0.05 * (1 + i % 7 * 3), i / 11.0));
    std::size_t made = 0;
    device.run(1800 * ms, [&](std::int64_t ns) {
        for (; made < events.size() && events[made].timeNs < ns + 100 * ms; ++made)
            output.onCollision(events[made]);
    });
    output.follow(nullptr);
    const auto model = padCommands(builtInPads().front().law, events, {}, phone(), 1800 * ms);
    const auto told = pad.told();
    const PadCounts counts = output.counts();
    EXPECT_EQ(counts.events, events.size());
    EXPECT_EQ(counts.refused, 0u);
    // A machine that is busy sends a command too late for it to count; everything else is there, in order.
    std::size_t at = 1;
    for (const auto& one : told) {
        const auto isIt = [&](const PadCommand& c) {
            return std::abs(c.low - one.low) < 1e-4 && std::abs(c.high - one.high) < 1e-4;
        };
        while (at < model.size() && !isIt(model[at])) ++at;
        ASSERT_LT(at, model.size()) << "not the model's: " << one.low << ' ' << one.high;
        EXPECT_GE(one.steadyNs, device.beganNs + model[at].timeNs - ms) << "before its time";
        ++at;
    }
    EXPECT_GE(told.size() + counts.late + 1, model.size());
    EXPECT_GE(told.size(), 15u);
    EXPECT_TRUE(pad.isAtRest());
}

TEST_F(OnePad, SilenceAndLevelZeroAreRestAtOnceAndWhatRingsComesBack) {
    CollisionEvent tone = hit(100 * ms, 60.0, 1.0, 0.5);
    tone.decayPerSecond = 0.0;
    tone.durationNs = 60'000 * ms;
    output.onCollision(tone);
    EXPECT_TRUE(soon([&] { return device.block(), !pad.isAtRest(); }));
    device.setSilent(true);
    EXPECT_TRUE(soon([&] { return pad.isAtRest(); }));
    device.run(device.sessionNs() + 100 * ms);
    EXPECT_TRUE(pad.isAtRest());
    device.setSilent(false);
    EXPECT_TRUE(soon([&] { return !pad.isAtRest(); }));
    device.setLevel(0.0f);
    EXPECT_TRUE(soon([&] { return pad.isAtRest(); }));
    device.setLevel(1.0f);
    EXPECT_TRUE(soon([&] { return !pad.isAtRest(); }));
    output.onControl({.timeNs = device.sessionNs()}); // a stop
    EXPECT_TRUE(soon([&] { return pad.isAtRest(); }));
}

TEST_F(Pads, NothingIsFeltWhenNobodyIsFollowedAndWhenTheSinkEnds) {
    VirtualPad pad{"short"};
    PacedDevice device;
    device.block();
    const auto ringing = [&](PadOutput& output) {
        output.follow(&device);
        device.block();
        CollisionEvent tone = hit(device.sessionNs(), 60.0, 1.0, 0.5);
        tone.decayPerSecond = 0.1;
        output.onCollision(tone);
        return soon([&] { return !pad.isAtRest(); });
    };
    {
        PadOutput output{"short", phone()};
        ASSERT_EQ(output.awaitReady(always), "");
        EXPECT_TRUE(ringing(output));
        output.follow(nullptr);
        EXPECT_TRUE(pad.isAtRest());
        EXPECT_TRUE(ringing(output));
    }
    EXPECT_TRUE(pad.isAtRest());
}

// Session time stands still meanwhile: what is felt then lies before what the motors have had already.
TEST_F(OnePadInRealTime, AfterAPauseOfTheDeviceTheyAreOnTimeAgain) {
    device.run(600 * ms);
    std::this_thread::sleep_for(std::chrono::milliseconds{400});
    device.beganNs += 400 * ms;
    device.block();
    const std::int64_t atNs = device.sessionNs() + 50 * ms;
    output.onCollision(hit(atNs, 60.0, 1.0, 0.5));
    device.run(atNs + 120 * ms);
    ASSERT_FALSE(pad.told().empty()) << "it waits for the time that the device stood still";
    EXPECT_GE(pad.told().front().steadyNs, device.beganNs + atNs - 60 * ms);
}

TEST_F(OnePad, UnpluggedItIsLookedForAndPlaysAgainWhenItIsBack) {
    pad.detach();
    EXPECT_TRUE(soon([&] { return !output.state().isReady; }));
    EXPECT_EQ(output.state().error, "one is gone; it is looked for");
    output.onCollision(hit(device.sessionNs(), 60.0, 1.0, 0.5)); // lost on nobody's account: no controller is
                                                                 // there
    pad.attach();
    EXPECT_TRUE(soon([&] { return output.state().isReady; }));
    EXPECT_EQ(output.state().error, "");
    const auto before = pad.told().size();
    device.block();
    output.onCollision(hit(device.sessionNs() + 50 * ms, 60.0, 1.0, 0.5));
    EXPECT_TRUE(soon([&] { return pad.told().size() > before; }));
    EXPECT_EQ(output.counts().connections, 2u);
}

TEST_F(OnePad, AFieldThatChangedWhileNobodyWasFollowedIsKept) {
    double heavyShares[2]{}; // of a hit at the right edge of the field before the change
    for (double& share : heavyShares) {
        const auto before = pad.told().size();
        output.onCollision(hit(device.sessionNs() + 40 * ms, 60.0, 0.1, 1.0));
        EXPECT_TRUE(soon([&] { return device.block(), pad.told().size() > before && pad.isAtRest(); }));
        share = pad.told()[before].low / (pad.told()[before].low + pad.told()[before].high);
        output.follow(nullptr);
        const PhantomPanner wide{phone().layout(), PanningLaw::linear, 1.0, 9.0, 1.0};
        output.onControl({.kind = RenderControl::Kind::panner, .panner = &wide});
        output.follow(&device);
    }
    EXPECT_GT(heavyShares[1], heavyShares[0] + 0.02);
}

TEST_F(OnePad, AControllerThatHangsHoldsUpNobody) {
    pad.hangs = true;
    output.onCollision(hit(50 * ms, 60.0, 1.0, 0.5));
    EXPECT_TRUE(soon([&] { return device.block(), pad.isHanging.load(); }));
    auto asked = std::async(std::launch::async, [&] {
        const bool isReady = output.state().isReady;
        output.follow(nullptr);
        return isReady && output.counts().events == 1;
    });
    EXPECT_EQ(asked.wait_for(std::chrono::seconds{2}), std::future_status::ready);
    pad.hangs = false;
    EXPECT_TRUE(asked.get());
    EXPECT_TRUE(soon([&] { return pad.isAtRest(); }));
}

/// A hit that begins and ends while the controller holds up a call is felt when it returns, then the rest.
TEST_F(OnePad, AHitDuringACallThatHangsIsFeltAfterIt) {
    pad.hangs = true;
    output.onCollision(hit(50 * ms, 60.0, 0.02, 0.5));
    ASSERT_TRUE(soon([&] { return device.block(), pad.isHanging.load(); }));
    CollisionEvent thump = hit(device.sessionNs() + 40 * ms, 60.0, 1.0, 0.5);
    thump.decayPerSecond = 100.0;
    output.onCollision(thump);
    device.run(600 * ms);
    pad.hangs = false;
    EXPECT_TRUE(soon([&] { return device.block(), pad.told().size() > 2 && pad.isAtRest(); }));
    double strongest = 0.0;
    for (const auto& told : pad.told()) strongest = std::max({strongest, told.low, told.high});
    EXPECT_EQ(strongest, 1.0);
}

TEST_F(Pads, TwoSinksTakeTwoControllersAndAThirdFindsNone) {
    VirtualPad one{"one"}, two{"two"};
    PadOutput first{anyPad, phone()}, second{anyPad, phone()};
    ASSERT_EQ(first.awaitReady(always), "");
    ASSERT_EQ(second.awaitReady(always), "");
    PadOutput third{anyPad, phone()};
    EXPECT_EQ(third.awaitReady([] { return false; }),
              "no game controller with motors is there: plug it in, or switch it on");
    EXPECT_EQ((PadOutput{"three", phone()}.awaitReady([] { return false; })),
              "no game controller with motors is called \"three\": plug it in, or choose another");
    EXPECT_EQ((PadOutput{"one@pad-atari", phone()}.awaitReady(always))
                  .rfind("no controller profile \"pad-atari\"", 0),
              0u);
}

TEST_F(Pads, AControllerHasTheProfileThatIsNamedWithIt) {
    VirtualPad pad{"one"};
    const auto labelOf = [](const std::string& name) {
        PadOutput output{name, phone()};
        EXPECT_EQ(output.awaitReady(always), "");
        return output.state().label;
    };
    EXPECT_NE(labelOf("one").find("): pad-generic, "), std::string::npos) << "its own";
    for (const PadProfile& profile : builtInPads())
        EXPECT_NE(labelOf("one@" + profile.name).find("): " + profile.name + ", "), std::string::npos);
}

TEST_F(OnePadInRealTime, AHitAndItsRepetitionsLastAsLongAsTheyRing) { // 200 ms are the longest command
    CollisionEvent tone = hit(50 * ms, 60.0, 1.0, 0.5);
    tone.decayPerSecond = 0.0;
    tone.durationNs = 800 * ms;
    output.onCollision(tone);
    device.run(1200 * ms);
    std::int64_t zeroNs = 0;
    for (const auto& told : pad.told())
        if (told.low == 0.0) zeroNs = told.steadyNs;
    EXPECT_GE(zeroNs - pad.told().front().steadyNs, 750 * ms);
    EXPECT_GE(output.counts().repeats, 4u);
    EXPECT_TRUE(pad.isAtRest());
}

// What a controller does at once, however slow its profile is.

class PadStopsInRealTime : public FolderTest {
protected:
    GamePads pads{}; // before any virtual one
};

/// A profile with five commands a second: a stop that waited for the next would come up to 200 ms later. The
/// quickest of some tries counts: another program may hold up any one of them.
TEST_F(PadStopsInRealTime, SilenceAndLevelZeroDoNotWaitForTheNextCommand) {
    PadProfile slow = builtInPads().front();
    slow.name = "pad-slow";
    slow.law.commandsPerSecond = 5.0;
    slow.law.leadSeconds = 0.0;
    put(folder / "slow.json", padJson(slow));
    for (const bool isLevel : {false, true}) {
        VirtualPad pad{"slow"};
        PadOutput output{"slow@" + (folder / "slow.json").string(), phone()};
        ASSERT_EQ(output.awaitReady(always), "");
        PacedDevice device;
        device.block();
        output.follow(&device);
        device.block();
        CollisionEvent tone = hit(device.sessionNs(), 60.0, 1.0, 0.5);
        tone.decayPerSecond = 0.0;
        tone.durationNs = 60'000 * ms;
        output.onCollision(tone);
        std::int64_t quickest = INT64_MAX;
        for (int i = 0; i < 5 && quickest > 100 * ms; ++i) {
            ASSERT_TRUE(soon([&] { return device.block(), !pad.isAtRest(); }));
            const std::int64_t saidNs = PacedDevice::now();
            isLevel ? device.setLevel(0.0f) : device.setSilent(true);
            ASSERT_TRUE(soon([&] { return device.block(), pad.isAtRest(); }));
            quickest = std::min(quickest, pad.told().back().steadyNs - saidNs);
            isLevel ? device.setLevel(1.0f) : device.setSilent(false);
        }
        EXPECT_LT(quickest, 100 * ms) << (isLevel ? "level" : "silence");
        output.follow(nullptr);
    }
}

/// A session that begins anew is felt from its own beginning, although the one before went further.
TEST_F(PadStopsInRealTime, ASessionThatBeginsAnewIsFelt) {
    VirtualPad pad{"again"};
    PadOutput output{"again", phone()};
    ASSERT_EQ(output.awaitReady(always), "");
    PacedDevice device;
    device.beganNs = PacedDevice::now() - 100'000 * ms; // it has played for long
    device.block();
    output.follow(&device);
    for (const bool isAnew : {false, true}) {
        if (isAnew) device.beganNs = PacedDevice::now();
        for (int i = 0; i < (isAnew ? 140 : 20); ++i) { // the clock looks back for half a second
            device.block();
            std::this_thread::sleep_for(std::chrono::milliseconds{5});
        }
        output.onCollision(hit(device.sessionNs(), 60.0, 1.0, 0.5));
        EXPECT_TRUE(soon([&] { return device.block(), !pad.isAtRest(); })) << (isAnew ? "anew" : "before");
        EXPECT_TRUE(soon([&] { return device.block(), pad.isAtRest(); }));
    }
    output.follow(nullptr);
}

} // namespace physvib::pad_output_test
