// SPDX-License-Identifier: MIT
// Which events can be played at all.
#include "Core/CollisionEvent.h"
#include <gtest/gtest.h>
#include <limits>

namespace physvib {
namespace {

CollisionEvent sound() {
    CollisionEvent e;
    e.frequencyHz = 205;
    e.decayPerSecond = 30;
    e.amplitude = 0.5;
    return e;
}

TEST(CollisionEvent, NoDecayNeedsADuration) {
    CollisionEvent e = sound();
    e.decayPerSecond = 0;
    EXPECT_FALSE(isPlayable(e));
    e.durationNs = 100'000'000;
    EXPECT_TRUE(isPlayable(e));
}

TEST(CollisionEvent, WhatIsSlowerThan5HzDecays) {
    CollisionEvent e = sound();
    e.durationNs = 10'000'000'000;
    const auto isTaken = [&](double frequencyHz, double decayPerSecond, std::int64_t travelNs = 0) {
        e.frequencyHz = frequencyHz;
        e.decayPerSecond = decayPerSecond;
        e.course.travelNs = travelNs;
        return isPlayable(e);
    };
    EXPECT_TRUE(isTaken(5.0, 0.0));
    EXPECT_FALSE(isTaken(4.999, 0.0));
    EXPECT_FALSE(isTaken(0.5, 1e-9)) << "a decay that is none";
    EXPECT_TRUE(isTaken(0.5, 1.0));
    EXPECT_FALSE(isTaken(2.0, 0.0, 10'000'000'000)) << "wherever it goes";
    e.sound = soundOfClip(3);
    EXPECT_TRUE(isTaken(clipFrequencyHz, 0.0)) << "a clip";
    EXPECT_FALSE(isTaken(clipFrequencyHz, 0.0, 10'000'000'000)) << "no clip moves";
    e.sound = soundOfMaterial("wood");
    EXPECT_TRUE(isTaken(80.0, 0.0, 10'000'000'000)) << "materials do";
    e.sound = -1;
    EXPECT_FALSE(isTaken(80.0, 0.0)) << "no sound has this number";
}

TEST(SoundNumber, AMaterialKeepsItsNumberInFilesOfAllVersions) {
    EXPECT_EQ(soundOfMaterial("wood"), 923368111);
    EXPECT_EQ(soundOfMaterial("steel"), 2095187368);
    EXPECT_FALSE(isClip(soundOfMaterial("wood")));
    EXPECT_FALSE(isClip(0));
    for (int k = 0; k < mostClips; ++k) EXPECT_TRUE(isClip(soundOfClip(k))) << k;
    EXPECT_FALSE(isClip(soundOfClip(mostClips)));
}

TEST(CollisionEvent, NothingThatIsNotANumberIsPlayable) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()})
        for (double CollisionEvent::*field :
             {&CollisionEvent::frequencyHz, &CollisionEvent::decayPerSecond, &CollisionEvent::amplitude,
              &CollisionEvent::x, &CollisionEvent::y}) {
            CollisionEvent e = sound();
            e.*field = bad;
            EXPECT_FALSE(isPlayable(e));
        }
}

TEST(CollisionEvent, LimitsAreKept) {
    const auto with = [](auto change) {
        CollisionEvent e = sound();
        change(e);
        return isPlayable(e);
    };
    EXPECT_FALSE(with([](auto& e) { e.timeNs = -1; }));
    EXPECT_FALSE(with([](auto& e) { e.timeNs = limits::maxTimeNs + 1; }));
    EXPECT_FALSE(with([](auto& e) { e.frequencyHz = 0; }));
    EXPECT_FALSE(with([](auto& e) { e.decayPerSecond = -1; }));
    EXPECT_FALSE(with([](auto& e) { e.decayPerSecond = limits::maxDecayPerSecond * 1.01; }));
    EXPECT_FALSE(with([](auto& e) { e.amplitude = -2 * limits::maxAmplitude; }));
    EXPECT_FALSE(with([](auto& e) { e.durationNs = -1; }));
}

} // namespace
} // namespace physvib
