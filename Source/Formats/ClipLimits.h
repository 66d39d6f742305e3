// SPDX-License-Identifier: MIT
// Limits of imported haptic files, each with the reason for its value.
#pragma once
#include <cstddef>

namespace physvib::limits {

constexpr std::size_t maxClipFileBytes = 24'000'000; // parsed JSON needs six times its bytes: 150 MB
constexpr std::size_t maxClipPoints = 500'000; // of all curves: 10,000 impacts on four actuators, of a dozen
                                               // points each
constexpr std::size_t maxClipStrikes = maxClipPoints / 2; // each has at least two points
constexpr std::size_t maxClipBands = 4096;      // of all channels: each may have a sounding wave at any time
constexpr double maxClipSeconds = 600.0;        // as for recordings, because a clip becomes samples
constexpr double maxClipSounding = 7200.0;      // seconds of all waves: one second of computing per thousand
constexpr double maxClipFrequencyHz = 10'000.0; // in MPEG's schema
constexpr double maxClipAmplitude = 1000.0;     // a channel's gain times an amplitude within -1 to 1

constexpr double maxAhapEventSeconds = 30.0; // for Apple's continuous events

} // namespace physvib::limits
