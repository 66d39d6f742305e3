// SPDX-License-Identifier: GPL-3.0-or-later
// Frequency bands of onset detection in music, and the onset itself.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace physvib {

struct BeatBand {
    std::string_view name;
    double lowHz = 0.0, highHz = 0.0;
};

/// Bass drum and bass; melody and body of the snare; cymbals and hi-hats. The gaps between are left out,
/// because every instrument has energy there.
inline constexpr std::array<BeatBand, 3> beatBands{
    {{"low", 30.0, 150.0}, {"mid", 200.0, 2500.0}, {"high", 6000.0, 16000.0}}};

/// An onset in one band.
struct BandOnset {
    std::int64_t frame = 0; ///< of the input, from 0
    int band = 0;           ///< index into beatBands
    double strength = 0.0;  ///< relative to the strongest onset of that band in the last seconds; above 0, up
                            ///< to 1
    bool operator==(const BandOnset&) const = default;
};

} // namespace physvib
