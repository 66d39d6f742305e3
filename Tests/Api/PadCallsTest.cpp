// SPDX-License-Identifier: MIT
// Motor commands of the C library are those of PadMotors, frame by frame.
#include "Core/Pads/PadMotors.h"
#include "Scene/PadFile.h"
#include "Support/SizedEvents.h"
#include <array>
#include <gtest/gtest.h>
#include <physvib/physvib.h>
#include <random>
#include <string>
#include <vector>

namespace physvib::pad_calls_test {

constexpr physvib_int64 secondNs = 1'000'000'000;

physvib_event padHit(physvib_int64 timeNs, double amplitude = 0.5, double x = 0.5) {
    physvib_event event = test::hitAt(timeNs, amplitude);
    event.x_m = x;
    return event;
}

struct PadHandle {
    explicit PadHandle(int count = 1, const char* profile = nullptr) {
        EXPECT_EQ(physvib_pads_create(count, 1.0, 1.0, profile, &name), PHYSVIB_OK) << physvib_error();
    }
    ~PadHandle() { physvib_pads_free(name); }
    PadHandle(const PadHandle&) = delete;
    PadHandle& operator=(const PadHandle&) = delete;
    physvib_motors pull(physvib_int64 untilNs) const {
        std::array<physvib_motors, 64> motors{};
        EXPECT_GE(physvib_pads_pull(name, untilNs, motors.data(), 64), 1) << physvib_error();
        return motors[0];
    }
    physvib_pads name = nullptr;
};

std::vector<physvib_event> randomHits(int count) {
    std::mt19937 random{7};
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution{low, high}(random);
    };
    std::vector<physvib_event> hits;
    physvib_int64 timeNs = secondNs;
    for (int i = 0; i < count; ++i) {
        timeNs += static_cast<physvib_int64>(1e9 * between(0.0, 0.1));
        hits.push_back(padHit(timeNs, between(0.0, 1.0), between(0.0, 1.0)));
        hits.back().frequency_hz = between(20.0, 500.0);
        hits.back().decay_per_s = between(5.0, 100.0);
    }
    return hits;
}

CollisionEvent padEvent(const physvib_event& e) {
    return {e.time_ns, e.frequency_hz, e.decay_per_s, e.amplitude, e.x_m, e.y_m};
}

TEST(PadCalls, FramesHaveTheStrongestCommandsOfPadMotors) {
    const auto hits = randomHits(1000);
    for (const char* profile : {"pad-generic", "pad-xbox"}) {
        PadMotors motors{findPad(profile).value.law};
        const PhantomPanner grips =
            PadMotors::makeGripPanner({{1.0, 1.0, 1, {}}, PanningLaw::linear, 1.0, 1.0, 1.0});
        const PadHandle pads{1, profile};
        std::size_t next = 0;
        int commands = 0;
        PadCommand last;
        for (physvib_int64 untilNs = 0; untilNs < hits.back().time_ns + secondNs; untilNs += secondNs / 60) {
            for (; next < hits.size() && hits[next].time_ns < untilNs + secondNs / 10; ++next) {
                motors.strike(padEvent(hits[next]), grips);
                ASSERT_EQ(physvib_pads_strike(pads.name, 0, &hits[next]), PHYSVIB_OK) << physvib_error();
            }
            PadCommand peak = motors.dueNs() <= untilNs ? PadCommand{} : last;
            for (; motors.dueNs() <= untilNs; ++commands) {
                last = motors.next(1.0);
                peak.low = std::max(peak.low, last.low), peak.high = std::max(peak.high, last.high);
            }
            const physvib_motors frame = pads.pull(untilNs);
            ASSERT_EQ(frame.low, peak.low) << profile << " at " << untilNs;
            ASSERT_EQ(frame.high, peak.high) << profile << " at " << untilNs;
        }
        EXPECT_GT(commands, 1000);
        EXPECT_EQ(pads.pull(10'000 * secondNs).high, 0.0);
    }
}

TEST(PadCalls, AHitThatComesLateIsAsStrongAsOneInTime) {
    const PadHandle late, early;
    const auto frameNs = [](int frame) { return 5 * secondNs + frame * secondNs / 60; };
    const physvib_event soon = padHit(frameNs(1) + 30'000'000), past = padHit(frameNs(0) - secondNs / 60);
    late.pull(frameNs(0)), early.pull(frameNs(0));
    ASSERT_EQ(physvib_pads_strike(early.name, 0, &soon), PHYSVIB_OK);
    ASSERT_EQ(physvib_pads_strike(late.name, 0, &past), PHYSVIB_OK);
    double strongest = 0.0;
    for (int frame = 1; frame < 30; ++frame) {
        const physvib_motors a = late.pull(frameNs(frame)), b = early.pull(frameNs(frame));
        EXPECT_EQ(a.low, b.low) << frame;
        EXPECT_EQ(a.high, b.high) << frame;
        strongest = std::max(strongest, a.high);
    }
    EXPECT_GT(strongest, 0.5);
}

TEST(PadCalls, EachPadFeelsItsOwnEventsAndTheirSide) {
    const PadHandle pads{2};
    const physvib_event right = padHit(secondNs, 0.5, 1.0);
    ASSERT_EQ(physvib_pads_strike(pads.name, 1, &right), PHYSVIB_OK);
    std::array<physvib_motors, 2> motors{};
    ASSERT_EQ(physvib_pads_pull(pads.name, secondNs, motors.data(), 2), 2);
    EXPECT_EQ(motors[0].low + motors[0].high, 0.0);
    EXPECT_GT(motors[1].high, motors[1].low);
}

TEST(PadCalls, AWorldsEventsAreMovedByTheDelay) {
    const physvib_world world = test::worldWithEvents(1);
    const PadHandle pads;
    EXPECT_EQ(physvib_pads_send(pads.name, 0, world, secondNs, 1), 1);
    EXPECT_EQ(pads.pull(secondNs - 40'000'000).high, 0.0);
    EXPECT_GT(pads.pull(secondNs).high, 0.0);
    EXPECT_EQ(physvib_pads_send(pads.name, 0, nullptr, 0, 1), PHYSVIB_ERROR_HANDLE);
    physvib_world_free(world);
}

TEST(PadCalls, StopRestsAndLetsTimeBeginAgain) {
    const PadHandle pads;
    const physvib_event hit = padHit(9 * secondNs), soon = padHit(secondNs / 10);
    physvib_pads_strike(pads.name, 0, &hit);
    EXPECT_GT(pads.pull(9 * secondNs).high, 0.0);
    physvib_motors motors{};
    EXPECT_EQ(physvib_pads_pull(pads.name, 8 * secondNs, &motors, 1), PHYSVIB_ERROR_ORDER);
    ASSERT_EQ(physvib_pads_stop(pads.name), PHYSVIB_OK);
    EXPECT_EQ(pads.pull(0).high, 0.0);
    physvib_pads_strike(pads.name, 0, &soon);
    EXPECT_GT(pads.pull(secondNs / 10).high, 0.0);
    ASSERT_EQ(physvib_pads_set_level(pads.name, 0.0), PHYSVIB_OK);
    EXPECT_EQ(pads.pull(secondNs).high, 0.0);
}

TEST(PadCalls, AHitThatEndedWithinAFrameIsOverInTheNext) {
    const PadHandle pads;
    const physvib_event hit = padHit(secondNs);
    physvib_pads_strike(pads.name, 0, &hit);
    EXPECT_GT(pads.pull(9 * secondNs).high, 0.0) << "its strongest";
    const physvib_motors next = pads.pull(10 * secondNs);
    EXPECT_EQ(next.high, 0.0);
    EXPECT_EQ(next.low, 0.0);
}

TEST(PadCalls, APullAfterALongPauseReturns) {
    const PadHandle pads;
    physvib_event hum = padHit(0);
    hum.decay_per_s = 0.0, hum.duration_ns = 1'000'000 * secondNs;
    ASSERT_EQ(physvib_pads_strike(pads.name, 0, &hum), PHYSVIB_OK);
    EXPECT_GT(pads.pull(10'000'000 * secondNs).high, 0.0);
}

TEST(PadCalls, RefusesWithALine) {
    physvib_pads none = nullptr;
    EXPECT_EQ(physvib_pads_create(0, 1.0, 1.0, nullptr, &none), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_pads_create(1, 0.0, 1.0, nullptr, &none), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_pads_create(1, 1.0, 1.0, "pad-none", &none), PHYSVIB_ERROR_FILE);
    EXPECT_NE(std::string{physvib_error()}.find("pad-xbox"), std::string::npos) << physvib_error();
    EXPECT_EQ(none, nullptr);
    const PadHandle pads{2};
    physvib_motors motors[2];
    const physvib_event hit = padHit(0);
    EXPECT_EQ(physvib_pads_pull(pads.name, 0, motors, 1), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_pads_pull(pads.name, -1, motors, 2), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_pads_strike(pads.name, 2, &hit), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_pads_strike(pads.name, 0, nullptr), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_pads_set_level(pads.name, -1.0), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_pads_free(none), PHYSVIB_ERROR_HANDLE);
    for (int i = 0; i < 256; ++i) ASSERT_EQ(physvib_pads_strike(pads.name, 0, &hit), PHYSVIB_OK);
    EXPECT_EQ(physvib_pads_strike(pads.name, 0, &hit), PHYSVIB_ERROR_FULL);
}

} // namespace physvib::pad_calls_test
