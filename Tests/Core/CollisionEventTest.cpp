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

TEST(CollisionEvent, AnOrdinaryHitIsPlayable) { EXPECT_TRUE(isPlayable(sound())); }

TEST(CollisionEvent, NoDecayNeedsADuration) {
    CollisionEvent e = sound();
    e.decayPerSecond = 0;
    EXPECT_FALSE(isPlayable(e));
    e.durationNs = 100'000'000;
    EXPECT_TRUE(isPlayable(e));
}

TEST(CollisionEvent, NothingThatIsNotANumberIsPlayable) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()})
        for (double CollisionEvent::*field : {&CollisionEvent::frequencyHz, &CollisionEvent::decayPerSecond,
                                              &CollisionEvent::amplitude, &CollisionEvent::x, &CollisionEvent::y}) {
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
