// SPDX-License-Identifier: MIT
// A gain over the time of a scene: straight lines in dB between points.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace physvib {

constexpr double leastStripDb = -60.0, mostStripDb = 6.0; ///< of faders and lanes; the least is silence

struct GainPoint {
    double seconds = 0.0; ///< of the world, since its scene began
    double db = 0.0;      ///< on top of the fader, leastStripDb (silence) to mostStripDb
    bool operator==(const GainPoint&) const = default;
};

/// Points in the order of their times; none: 0 dB.
using GainLane = std::vector<GainPoint>;
constexpr std::size_t mostGainPoints = 2'000;

/// In steps of 0.1 dB, as faders have. Any thread, as all of these.
double laneDbAt(const GainLane& lane, double seconds) noexcept;
double loudestDb(const GainLane& lane) noexcept; ///< of its points

/// Gains behind each other: silence if one of them is, and within the range of a fader.
double sumDb(std::initializer_list<double> gainsDb) noexcept;

/// A lane that is the sum of both at each of their points (allocates).
GainLane sumOf(const GainLane& a, const GainLane& b);

/// Without points that are within 0.25 dB of the line between their neighbours, and at most so many
/// (allocates).
GainLane thinned(const GainLane& lane, std::size_t mostPoints = mostGainPoints);

} // namespace physvib
