// SPDX-License-Identifier: MIT
// Learns the level of a world's hits.
#include "Contacts/FullScale.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

// The exponent of a strength is 1.5: between 1, the sum of vibrations in phase, and 2, of those that are not.
double powerOf(double strength) { return strength * std::sqrt(strength); }
double strengthOf(double power) { return std::cbrt(power * power); }

// Infinite if neither body can be moved: such an impact says nothing about speeds.
double lighterMassKg(const Impact& impact, const FixtureTable& table) {
    const double own = table[impact.camera].movableMassKg();
    return impact.other == FixtureTable::none ? own : std::min(own, table[impact.other].movableMassKg());
}

} // namespace

void FullScale::learn(std::span<const Impact> impacts, const StepSpan& step, const FixtureTable& table) {
    double power = 0.0, heaviestKg = 0.0;
    bool isHeard = false;
    for (const Impact& impact : impacts) {
        if (table[impact.camera].values.gain == 0.0) continue;
        isHeard = true;
        if (impact.kind == ContactKind::hit) power += powerOf(impact.newtonSeconds);
        const double massKg = lighterMassKg(impact, table);
        if (std::isfinite(massKg)) heaviestKg = std::max(heaviestKg, massKg);
    }
    if (!isHeard) return;
    const double seconds = static_cast<double>(step.endNs - learnedNs_) * 1.0e-9;
    learnedNs_ = step.endNs;
    sounding_ = strengthOf(powerOf(sounding_ * std::exp(-fadePerSecond * seconds)) + power);
    const double fallen = level_ * std::exp(-std::min(seconds, longestPauseSeconds) / fallSeconds);
    const double thresholds = level_ > 0.0 ? leastThresholds : firstThresholds;
    level_ = std::max({fallen, sounding_, thresholds * step.leastMetresPerSecond * heaviestKg});
}

} // namespace physvib
