// SPDX-License-Identifier: GPL-3.0-or-later
// Drivers that hang, however long: nobody waits longer than said; what comes late is taken up or closed.
#include "Live/Devices/DeviceSession.h"
#include "FakeAudioDevice.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Devices/DeviceMeters.h"
#include "Session/FakeHost.h"
#include <gtest/gtest.h>
#include <numeric>
#include <thread>

namespace physvib::device_session_test {

using namespace test;
using namespace std::chrono_literals;

constexpr auto noTime = 5ms, muchTime = std::chrono::milliseconds{60s};

DeviceRequest wishOf(const std::string& name) {
    DeviceRequest wish{.name = name};
    wish.outputs = {0, 1, 2, 3};
    return wish;
}

struct Counted final : AudioDeviceCallback {
    void processBlock(const float* const*, int, float* const* out, int outputs,
                      int frames) noexcept override {
        ++blocks;
        for (int k = 0; k < outputs; ++k) std::fill_n(out[k], frames, 0.5f);
    }
    void aboutToStart(AudioDevice&) override { ++starts; }
    void stopped() override { ++stops; }
    int blocks = 0, starts = 0, stops = 0;
};

constexpr const char* noAnswer = "hands: its driver does not answer; nothing else is played on";

/// As whoever keeps a device asks, again and again.
std::string openAtLast(DeviceSession& keeper, const DeviceRequest& wish) {
    std::string error = noAnswer;
    for (int i = 0; i < 60'000 && error == noAnswer; ++i) {
        error = keeper.open(wish, muchTime);
        std::this_thread::sleep_for(1ms);
    }
    return error;
}

TEST(DeviceSession, NobodyWaitsForADriverThatHangsAndWhatItOpensLateIsTakenUp) {
    FakeInterface thing;
    DeviceSession keeper{fakeDrivers({&thing}), nullptr};
    thing.hangsIn = FakeInterface::Call::open;
    EXPECT_EQ(keeper.open(wishOf("hands"), noTime), noAnswer);
    EXPECT_EQ(keeper.open(wishOf("hands"), muchTime), noAnswer)
        << "asked once, then looked at; else this test takes a minute";
    EXPECT_EQ(keeper.device(), nullptr);
    thing.goOn();
    EXPECT_EQ(openAtLast(keeper, wishOf("hands")), "");
    EXPECT_EQ(thing.timesOpened, 1);
    EXPECT_NE(keeper.device(), nullptr);
}

TEST(DeviceSession, WhatIsOpenedLateAndNoLongerWantedIsClosed) {
    FakeInterface thing;
    DeviceSession keeper{fakeDrivers({&thing}), nullptr};
    thing.hangsIn = FakeInterface::Call::open;
    EXPECT_EQ(keeper.open(wishOf("hands"), noTime), noAnswer);
    auto other = wishOf("hands");
    other.outputs.insert(6);
    thing.goOn();
    EXPECT_EQ(openAtLast(keeper, other), "");
    EXPECT_EQ(thing.timesOpened, 2);
    EXPECT_EQ(thing.opened, other.outputs);
    keeper.close();
    EXPECT_EQ(thing.device, nullptr);
}

TEST(DeviceSession, HurryEndsTheWaiting) {
    FakeInterface thing;
    std::atomic<bool> cancel{true};
    DeviceSession keeper{fakeDrivers({&thing}), &cancel};
    thing.hangsIn = FakeInterface::Call::open;
    EXPECT_EQ(keeper.open(wishOf("hands"), muchTime), noAnswer) << "else this test takes a minute";
    thing.goOn();
}

TEST(DeviceSession, WhoIsLetGoIsCalledNoMoreAndTheDeviceHearsSilence) {
    FakeInterface thing;
    DeviceSession keeper{fakeDrivers({&thing}), nullptr};
    Counted owner;
    ASSERT_EQ(keeper.open(wishOf("hands"), muchTime), "");
    keeper.start(owner);
    EXPECT_EQ(owner.starts, 1);
    EXPECT_GT(peakOf(thing.play(64)), 0.0f);
    keeper.detach();
    EXPECT_EQ(peakOf(thing.play(64)), 0.0f);
    keeper.close();
    EXPECT_EQ(owner.blocks, 1);
    EXPECT_EQ(owner.stops, 0);
}

TEST(DeviceSession, ADeviceThatDoesNotCloseIsLeftAndAnotherCanBeOpened) {
    FakeInterface hung, other;
    other.name = "feet";
    const int before = DeviceThread::abandonedThreads();
    {
        DeviceSession keeper{fakeDrivers({&hung, &other}), nullptr};
        Counted owner;
        ASSERT_EQ(keeper.open(wishOf("hands"), muchTime), "");
        keeper.start(owner);
        hung.hangsIn = FakeInterface::Call::close;
        keeper.close(noTime);
        EXPECT_EQ(peakOf(hung.play(64)), 0.0f) << "though it is open";
        EXPECT_EQ(keeper.open(wishOf("Fake:hands"), noTime), "Fake:" + std::string{noAnswer})
            << "it is not asked twice at once";
        EXPECT_EQ(DeviceThread::abandonedThreads(), before);
        ASSERT_EQ(keeper.open(wishOf("feet"), muchTime), "");
        EXPECT_EQ(DeviceThread::abandonedThreads(), before + 1);
        EXPECT_EQ(owner.blocks, 0);
    }
    hung.goOn();
    while (DeviceThread::abandonedThreads() > before) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(hung.device, nullptr) << "closed after all";
}

TEST(AudioDevices, ADriverThatDoesNotAnswerIsListedAsSuchBesideTheOthers) {
    FakeInterface hung, other;
    other.name = "feet";
    hung.hangsIn = FakeInterface::Call::scan;
    const int before = DeviceThread::abandonedThreads();
    const auto both = [&] {
        auto drivers = fakeDrivers({&hung}, "Hung")();
        drivers.push_back(std::move(fakeDrivers({&other})().front()));
        return drivers;
    };
    std::string listed;
    for (const auto& device : listAudioDevices(both))
        listed += device.type + ":" + device.name + " " + std::to_string(device.channels) + "\n";
    EXPECT_EQ(listed, "Hung:does not answer 0\nFake:feet 8\n");
    hung.goOn();
    while (DeviceThread::abandonedThreads() > before) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(listAudioDevices(both).front().name, "hands");
}

/// An output on an interface whose driver can hang.
struct Rig {
    FakeInterface interface;
    Session session{shakeTheBoxSetup(0.02)};
    AudioOutput output{session, fakeDrivers({&interface})};
    Rig() {
        EXPECT_EQ(output.open({"hands"}), "");
        interface.play(64);
    }
};

TEST(AudioOutput, ADriverThatHangsIsToldAndPlayedOnAgainWhenItAnswers) {
    Rig rig;
    rig.interface.hangsIn = FakeInterface::Call::close; // its server is stopped: no answer
    auto now = AudioOutput::Clock::now();
    std::string told;
    for (int second = 0; second < 6; ++second) told = rig.output.maintain(now += 1s);
    EXPECT_EQ(told, std::string{"Fake:"} + noAnswer);
    EXPECT_FALSE(rig.output.status().isRunning);
    EXPECT_EQ(peakOf(rig.interface.play(64)), 0.0f);
    rig.interface.goOn();
    for (int i = 0; i < 60'000 && !told.empty(); ++i, std::this_thread::sleep_for(1ms))
        told = rig.output.maintain(now += 1s);
    EXPECT_EQ(told, "");
    EXPECT_EQ(rig.output.status().losses, 1);
    const auto blocks = rig.output.status().blocks;
    rig.interface.play(64);
    EXPECT_EQ(rig.output.status().blocks, blocks + 1);
}

TEST(AudioOutput, WhoeverStoppedAnOutputMayEndWhileItsDeviceHangs) {
    Rig rig;
    rig.interface.hangsIn = FakeInterface::Call::close;
    rig.output.stop();
    EXPECT_EQ(peakOf(rig.interface.play(64)), 0.0f) << "R has left the session";
    rig.output.close();
    EXPECT_EQ(rig.output.device(), "");
    rig.interface.goOn();
}

TEST(AudioOutput, ARateThatChangesUnderUsIsToldAndFollowed) {
    Rig rig;
    EXPECT_EQ(rig.output.maintain(), "");
    rig.interface.rate = 44'100;
    EXPECT_EQ(rig.output.maintain(), "Fake:hands: runs at 44100 Hz now, at 48000 Hz before");
    EXPECT_EQ(rig.output.sampleRateHz(), 44'100);
    EXPECT_EQ(rig.output.maintain(), "") << "told once";
    const auto blocks = rig.output.status().blocks;
    rig.interface.play(64);
    EXPECT_EQ(rig.output.status().blocks, blocks + 1);
    EXPECT_EQ(rig.interface.timesOpened, 1);
}

TEST(AudioOutput, APauseOfTheProgramIsNotALossOfItsDevice) {
    Rig rig;
    auto now = AudioOutput::Clock::now();
    EXPECT_EQ(rig.output.maintain(now), "");
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(rig.output.maintain(now += 2200ms), "")
            << "stopped, and on again before the device has asked";
    EXPECT_EQ(rig.output.status().losses, 0);
    EXPECT_EQ(rig.interface.timesOpened, 1);
}

// A device that asks for nothing has gone; a program that did not look has not lost one.

using namespace std::chrono_literals;

/// Looks at a clock of its own.
struct Looks {
    bool after(std::chrono::milliseconds pause, std::uint64_t moreBlocks, bool isIdle = false) {
        return watch.isGone(now += pause, blocks += moreBlocks, isIdle);
    }
    DeviceWatch watch;
    DeviceWatch::Clock::time_point now{10h};
    std::uint64_t blocks = 0;
};

TEST(DeviceWatch, ADeviceThatAsksForNothingForTwoSecondsHasGone) {
    Looks look;
    EXPECT_FALSE(look.after(0s, 0));
    for (int i = 0; i < 5; ++i) EXPECT_FALSE(look.after(1s, 94));
    EXPECT_FALSE(look.after(1s, 0));
    EXPECT_FALSE(look.after(1s, 0));
    EXPECT_TRUE(look.after(1s, 0));
    EXPECT_TRUE(look.after(1s, 0)) << "and has still";
    EXPECT_FALSE(look.after(1s, 1)) << "until it asks again";
}

TEST(DeviceWatch, OneThatHasNothingToAskForHasNotGone) {
    Looks look;
    for (int i = 0; i < 10; ++i) EXPECT_FALSE(look.after(1s, 0, true));
}

TEST(DeviceWatch, APauseIsNotALoss) {
    for (const auto pause : {2001ms, 2200ms, 3300ms, 60'000ms, 36'000'000ms}) {
        Looks look;
        look.after(0s, 1);
        look.after(1s, 94);
        EXPECT_FALSE(look.after(pause, 0)) << "a late look says nothing: " << pause.count() << " ms";
        EXPECT_FALSE(look.after(1s, 0)) << "the device has two seconds from then";
        EXPECT_FALSE(look.after(1s, 0));
        EXPECT_TRUE(look.after(1s, 0)) << "and no more";
    }
}

TEST(DeviceWatch, ADeviceThatWasOpenedAgainHasItsTwoSeconds) {
    Looks look;
    look.after(0s, 1);
    for (int i = 0; i < 3; ++i) look.after(1s, 0);
    look.watch.countLoss(look.now);
    EXPECT_FALSE(look.after(1s, 0));
    EXPECT_FALSE(look.after(1s, 0));
    EXPECT_TRUE(look.after(1s, 0));
}

TEST(SignalTap, IsReadAsItWasPushedWhereverItWraps) {
    std::vector<float> signal(1000), read;
    std::iota(signal.begin(), signal.end(), 0.0f);
    SignalTap tap{1, 10};
    for (std::size_t frames = 1; read.size() + frames <= signal.size(); frames = frames % 7 + 1) {
        const float* const channel = signal.data() + read.size();
        tap.push(&channel, static_cast<int>(frames));
        tap.read(
            [&](const float* const* part, int count) { read.insert(read.end(), part[0], part[0] + count); });
    }
    EXPECT_EQ(tap.framesLost(), 0U);
    EXPECT_GT(read.size(), 990U);
    EXPECT_TRUE(std::equal(read.begin(), read.end(), signal.begin()));
}

} // namespace physvib::device_session_test
