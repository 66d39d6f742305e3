// SPDX-License-Identifier: MIT
// The impulse that gives full scale, learned from the hits of a world, so that nobody has to guess a gain.
#pragma once
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include <span>

namespace physvib {

/// Follows the strength of the hardest usual hit and puts it 6 dB below full scale.
///
/// Strength is the impulse of what sounds at once: impulses are summed to the power of 1.5, between the sum
/// of vibrations in phase and that of powers. It fades by 30 per second, as a usual vibration does. The level
/// rises to it at once, so no hit is played above the goal. It falls by a time constant of 10 s, of which a
/// pause counts 1 s at most: a quiet minute does not make the next touch loud.
///
/// The speeds below are multiples of the threshold for impacts, which fits the scale of the world. At first
/// the level is that of a change of the lighter body's velocity by 10 thresholds (1.5 m/s by default). It is
/// never below 2 thresholds (0.3 m/s), so the smallest impact stays 6 dB below the goal.
///
/// It depends on simulated time and impulses only. World thread (M).
class FullScale {
public:
    static constexpr double goal = 0.5; ///< amplitude of the hardest usual hit: 6 dB below full scale
    static constexpr double fallSeconds = 10.0;
    static constexpr double longestPauseSeconds = 1.0;
    static constexpr double fadePerSecond = 30.0;
    static constexpr double firstThresholds = 10.0;
    static constexpr double leastThresholds = 2.0;

    /// Learns from the impacts of a step, whatever their order. Those of muted sources do not count, and
    /// grains do not raise the level.
    void learn(std::span<const Impact> impacts, const StepSpan& step, const FixtureTable& table);

    /// The impulse of an amplitude of 1. Until something was learned 1, which keeps the order of impacts.
    double newtonSeconds() const noexcept { return level_ > 0.0 ? level_ / goal : 1.0; }

private:
    double level_ = 0.0;    // N s, of the goal
    double sounding_ = 0.0; // N s, of what sounds at once
    std::int64_t learnedNs_ = 0;
};

} // namespace physvib
