// SPDX-License-Identifier: MIT
// Limits of the haptic files of others, with the reason for each value.
#pragma once
#include <cstddef>

namespace physvib::limits {

constexpr std::size_t maxClipFileBytes = 24'000'000; // a field of JSON takes six times its bytes while it is
                                                     // read: 150 MB
constexpr std::size_t maxClipPoints = 500'000; // of all curves: 10,000 hits on four enchanters, of a dozen
                                               // each
constexpr std::size_t maxClipStrikes = maxClipPoints / 2; // each takes two points at least
constexpr std::size_t maxClipBands = 4096; // of all channels: a wave each may sound at any moment
constexpr double maxClipSeconds = 600.0;   // as of recordings: a clip becomes samples
constexpr double maxClipSounding = 7200.0; // seconds of all waves: a second of arithmetic for each thousand
constexpr double maxClipFrequencyHz = 10'000.0; // of MPEG's schema
constexpr double maxClipAmplitude = 1000.0;     // a channel's gain times an amplitude within -1 to 1

constexpr double maxAhapEventSeconds = 30.0; // of Apple's continuous events

constexpr std::size_t maxTextureFileBytes = 16'000'000; // the toolkit's have under a tenth
constexpr std::size_t maxTextureModels = 4096;          // of speeds and forces
constexpr std::size_t maxTextureCoefficients = 256;     // of each

} // namespace physvib::limits
