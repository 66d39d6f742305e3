// SPDX-License-Identifier: MIT
// Gain automation over the time of a scene run: points joined by straight lines in dB.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace physvib {

constexpr double leastStripDb = -60.0, mostStripDb = 6.0; ///< faders and lanes; least is silence

struct GainPoint {
    double seconds = 0.0; ///< of the world, from the start of the scene run
    double db = 0.0;      ///< added to the fader, leastStripDb (silence) to mostStripDb
    bool operator==(const GainPoint&) const = default;
};

/// Points in time order; none: 0 dB.
using GainLane = std::vector<GainPoint>;
constexpr std::size_t mostGainPoints = 2'000;

/// Rounded to steps of 0.1 dB, as faders have. Any thread, as all functions here.
double laneDbAt(const GainLane& lane, double seconds) noexcept;
double loudestDb(const GainLane& lane) noexcept; ///< largest value of its points

/// Total of gains in series: silence if one of them is, and limited to the range of a fader.
double sumDb(std::initializer_list<double> gainsDb) noexcept;

/// The sum of both lanes, with the points of both (allocates).
GainLane sumOf(const GainLane& a, const GainLane& b);

/// Removes points within 0.25 dB of the line between their neighbours, and more until at most `mostPoints`
/// remain (allocates).
GainLane thinned(const GainLane& lane, std::size_t mostPoints = mostGainPoints);

} // namespace physvib
