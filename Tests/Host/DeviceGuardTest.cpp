// SPDX-License-Identifier: GPL-3.0-or-later
// What an output has had is not forgotten when the device's period or rate changes, when it is opened anew,
// or when another actuator plays there.
#include "FakeAudioDevice.h"
#include "Host/OpeningsPath.h"
#include "Live/Devices/AudioOutput.h"
#include "Session/FakeHost.h"
#include <gtest/gtest.h>
#include <numeric>

namespace physvib::device_guard_test {

using namespace test;

/// Half waves of 200 Hz on one actuator, without limiter and so without the session's guard.
class HalfWaves {
public:
    explicit HalfWaves(FakeInterface& interface)
        : interface_{interface} {}

    void open(AudioOutput& output) { ASSERT_EQ(output.open({"hands", {}, 0, 0, 1.0f, 0, true}), ""); }
    void play(Session& session, double seconds, double x = 0.0) {
        for (int left = static_cast<int>(seconds * interface_.rate); left > 0; left -= interface_.block) {
            const CollisionEvent half{
                .frequencyHz = 200.0, .amplitude = 4.0, .x = x, .y = 0.5, .durationNs = 2'500'000};
            session.submit({Strikes{{&half, 1}}});
            session.advance();
            const auto blocks = interface_.play(interface_.block);
            const auto count = static_cast<std::size_t>(interface_.rate / 8000); // means keep slow
            for (std::size_t k = 0; k < blocks.size(); ++k)
                for (std::size_t n = 0; n + count <= blocks[k].size(); n += count)
                    left_.at(k).push_back(std::accumulate(&blocks[k][n], &blocks[k][n] + count, 0.0f) /
                                          static_cast<float>(count));
            PlayedTime::pass(double(interface_.block) / interface_.rate);
        }
    }
    SlowFigures worst() const {
        SlowFigures all;
        for (const auto& output : left_) all.join(slowFigures(output, 8000));
        return all;
    }
    void expectWithin() const {
        EXPECT_LE(worst().mean, limits::guardShare);
        EXPECT_LE(worst().rms, limits::guardShare);
        EXPECT_GT(worst().mean, 0.5 * limits::guardShare) << "something is played";
    }

private:
    FakeInterface& interface_;
    std::array<std::vector<float>, 8> left_;
};

SessionSetup twoActuators() {
    auto s = shakeTheBoxSetup(0.02);
    s.hasWorld = false;
    s.channels = 2;
    ActuatorLayout places{1, 1, 2, {}};
    places.places[0] = {0.0, 0.5};
    places.places[1] = {1.0, 0.5};
    s.panner = {places, PanningLaw::linear, 1, 1, 1};
    s.limiterEnabled = false;
    return s;
}

struct GuardRig {
    PlayedTime time;
    FakeInterface interface;
    HalfWaves waves{interface};
    AudioDrivers drivers = fakeDrivers({&interface});
};

/// With the device open.
struct OpenRig : GuardRig {
    Session session{twoActuators()};
    AudioOutput output{session, drivers};
    OpenRig() { waves.open(output); }
    void play(double seconds, double x = 0.0) { waves.play(session, seconds, x); }
};

TEST(DeviceGuard, PeriodsAndRatesThatChangeAreNoWayAround) {
    OpenRig rig;
    for (const auto& [rate, block] : std::vector<std::pair<int, int>>{{48000, 64},
                                                                      {48000, 128},
                                                                      {48000, 256},
                                                                      {96000, 256},
                                                                      {48000, 512},
                                                                      {8000, 512},
                                                                      {48000, 1024}}) {
        rig.interface.rate = rate;
        rig.interface.block = block;
        rig.output.maintain();
        rig.play(0.12);
    }
    EXPECT_GE(rig.interface.timesStarted, 6);
    rig.waves.expectWithin();
}

// As a program that opens the device for each hit.
TEST(DeviceGuard, OpeningAnewIsNoWayAround) {
    GuardRig rig;
    for (int k = 0; k < 20; ++k) {
        Session session{twoActuators()};
        AudioOutput output{session, rig.drivers};
        rig.waves.open(output);
        rig.waves.play(session, k % 3 == 0 ? 0.06 : 0.1);
    }
    rig.waves.expectWithin();
}

TEST(DeviceGuard, ADeviceThatGoesAndComesIsNoWayAround) {
    OpenRig rig;
    for (int k = 0; k < 20; ++k) {
        rig.play(0.08);
        rig.interface.unplug(true);
        rig.interface.isPlugged = true;
        rig.output.maintain();
    }
    rig.waves.expectWithin();
}

// Two actuators exchange their outputs, and each is loud where the other has been.
TEST(DeviceGuard, AnotherActuatorOnTheOutputIsNoWayAround) {
    OpenRig rig;
    for (int k = 0; k < 20; ++k) {
        ASSERT_EQ(rig.output.assign(k % 2 == 0 ? std::vector<int>{0, 1} : std::vector<int>{1, 0}, 2), "");
        rig.play(0.1, k % 2);
    }
    rig.waves.expectWithin();
}

// A study borrows the output again and again, with a session that has had nothing.
TEST(DeviceGuard, ABorrowedSessionOnTheOutputIsNoWayAround) {
    OpenRig rig;
    for (int k = 0; k < 20; ++k) {
        Session lent{twoActuators()};
        ASSERT_TRUE(rig.output.playInstead(&lent));
        rig.waves.play(lent, 0.1);
        ASSERT_TRUE(rig.output.playInstead(nullptr));
        if (k % 3 == 0) rig.play(0.05);
    }
    rig.waves.expectWithin();
}

/// On output 2, counted from 0, in an opening of its own.
void playAnew(const std::string& device, std::vector<float>& samples) {
    DeviceGuard guard;
    guard.begin(device, {0, 2}, 48000);
    std::array<float*, limits::maxActuators> at{};
    at[0] = samples.data();
    guard.setChannel(0, 1);
    guard.process(at.data(), static_cast<int>(samples.size()));
    PlayedTime::pass(double(samples.size()) / 48000);
}

TEST(DeviceGuard, WhatAnOutputHadIsForgottenInTimeAndElsewhereNeverKnown) {
    const PlayedTime time;
    const auto hadBy = [](const std::string& device, int output) {
        return GuardMemory::storedFor(device, output).sums.load;
    };
    std::vector<float> slow(12000, 0.2f);
    playAnew("A:one", slow);
    const float had = hadBy("A:one", 2);
    EXPECT_GT(had, 0.8f * limits::guardLoad);
    EXPECT_EQ(hadBy("A:one", 0) + hadBy("A:one", 1) + hadBy("A:two", 2), 0.0f);
    PlayedTime::pass(2.0);
    EXPECT_NEAR(hadBy("A:one", 2), had * std::exp(-2.0f), 0.2f * had * std::exp(-2.0f));
    PlayedTime::pass(6.5);
    EXPECT_EQ(hadBy("A:one", 2), 0.0f);
    for (int k = 0; k < 1000; ++k) GuardMemory::store("A:three", k, {.load = 1e-3f}); // of bounded size
    EXPECT_GT(hadBy("A:three", 999), 0.0f);
}

// The samples of a felt tone are the same in the first opening and in the tenth.
TEST(DeviceGuard, WhatItDoesNotActOnKeepsItsBits) {
    const PlayedTime time;
    std::vector<float> first;
    for (int k = 0; k < 10; ++k) {
        std::vector<float> tone(4800);
        for (std::size_t n = 0; n < tone.size(); ++n) tone[n] = std::sin(0.0262f * static_cast<float>(n));
        if (first.empty()) first = tone;
        playAnew("A:one", tone);
        ASSERT_EQ(tone, first) << k;
    }
}

// What pulls back is not forgotten for what pushed before: an opening's sums take the place of those that it
// went on from.
TEST(DeviceGuard, OpenedAnewItKnowsWhatItWouldHaveKnown) {
    const PlayedTime time;
    std::vector<float> push(4800, 0.05f), pull(2400, -0.05f), both = push;
    both.insert(both.end(), pull.begin(), pull.end());
    playAnew("A:one", both);
    const GuardSums one = GuardMemory::storedFor("A:one", 2).sums;
    playAnew("A:two", push);
    playAnew("A:two", pull);
    const GuardSums two = GuardMemory::storedFor("A:two", 2).sums;
    EXPECT_NEAR(two.slow, one.slow, 0.002f);
    EXPECT_NEAR(two.load, one.load, 0.05f * one.load);
}

// Two sessions on one output, which both began when it had had nothing.
TEST(DeviceGuard, WhoEndsLastForgetsNothingOfWhatTheOtherHad) {
    const PlayedTime time;
    const auto hadBy = [](const std::string& name) { return GuardMemory::storedFor(name, 2).sums.load; };
    std::vector<float> loud(4800, 0.2f), alone = loud, quiet(4800, 0.01f);
    playAnew("A:one", alone);
    const float had = hadBy("A:one");
    {
        DeviceGuard last;
        last.begin("A:two", {0, 2}, 48000);
        last.setChannel(0, 1);
        std::array<float*, limits::maxActuators> at{quiet.data()};
        last.process(at.data(), 4800);
        playAnew("A:two", loud);
        EXPECT_EQ(hadBy("A:two"), had);
    }
    EXPECT_EQ(hadBy("A:two"), had);
}

// With all of its channels in use, a new output gets that of an output that has had least: what others have
// had is not forgotten, and the new one is not turned down for it.
TEST(DeviceGuard, OfManyOutputsTheLeastLoadedIsForgottenForANewOne) {
    const PlayedTime time;
    constexpr int all = limits::maxActuators, idle = 40;
    const auto hadBy = [](int output) { return GuardMemory::storedFor("A:many", output).sums.load; };
    const auto play = [](DeviceGuard& guard, std::vector<std::pair<int, float>> actuators) {
        std::vector<std::vector<float>> samples;
        for (const auto& actuator : actuators) samples.emplace_back(9600, actuator.second);
        std::array<float*, limits::maxActuators> at{};
        for (std::size_t k = 0; k < actuators.size(); ++k)
            at[static_cast<std::size_t>(actuators[k].first)] = samples[k].data();
        guard.process(at.data(), 9600);
        return samples.back().back();
    };
    {
        DeviceGuard guard;
        ChannelSet outputs;
        for (int k = 0; k <= all; ++k) outputs.insert(k);
        guard.begin("A:many", outputs, 48000);
        std::vector<std::pair<int, float>> loud;
        for (int j = 0; j < all; ++j) {
            guard.setChannel(j, j);
            if (j != idle) loud.emplace_back(j, 0.2f);
        }
        play(guard, loud);
        play(guard, {{1, 0.2f}}); // all others have stopped
        guard.setChannel(0, all);
        EXPECT_EQ(play(guard, {{0, 0.01f}}), 0.01f) << "it has had nothing";
    }
    for (const int output : {0, 1, 39, 41, 63}) EXPECT_GT(hadBy(output), 1e-4f) << output;
    EXPECT_LT(hadBy(all), 1e-4f);
}

// The search of GuardAttack, over openings.
TEST(DeviceGuard, AnAttackOverOpeningsFindsNoneThatPasses) {
    const PlayedTime time;
    const GuardPath path = openingsPath(8000);
    AttackSearch search{[&](const GuardAttack& a) { return figuresBehind(path, a).rms; }, 7};
    search.climb(100, 10);
    search.shape(100, 60);
    const auto worst = figuresBehind(path, search.worst);
    EXPECT_LE(worst.rms, limits::guardShare);
    EXPECT_LE(worst.mean, limits::guardShare);
}

} // namespace physvib::device_guard_test
