// SPDX-License-Identifier: GPL-3.0-or-later
// The bands in which onsets of music are looked for, and an onset.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace physvib {

struct BeatBand {
    std::string_view name;
    double lowHz = 0.0, highHz = 0.0;
};

/// Bass drum and bass; what sings, and the snare's body; cymbals and hats. What lies between belongs to all,
/// and tells nothing.
inline constexpr std::array<BeatBand, 3> beatBands{
    {{"low", 30.0, 150.0}, {"mid", 200.0, 2500.0}, {"high", 6000.0, 16000.0}}};

/// An onset in one of them.
struct BandOnset {
    std::int64_t frame = 0; ///< of the sound, from 0
    int band = 0;           ///< of beatBands
    double strength = 0.0;  ///< beside the strongest of that band in the last seconds: above 0, to 1
    bool operator==(const BandOnset&) const = default;
};

} // namespace physvib
