// SPDX-License-Identifier: MIT
// What a vector kernel is given of one tile of 64 frames: modes, amplitudes, carriers, strikes.
//
// Low rank: inside a tile any decaying sinusoid of less than a turn or so is a combination of a few
// polynomials (LowRankBasis.h). A mode is a row of complex coefficients, fixed for life; a tile is the
// product of the modes' amplitudes with these rows, summed over modes, and one expansion per channel at the
// end, whatever the number of modes.
#pragma once
#include "Core/Limits.h"
#include <array>
#include <cstdint>

namespace physvib {

namespace tiles {
constexpr int frames = limits::tileFrames;         // one mode's share stays in registers
constexpr std::array<int, 4> ranks{8, 16, 32, 64}; // coefficients of a row; 64: the tile's frames themselves
constexpr int maxRank = 32;                        // of the polynomials
constexpr int channelsPerLine = 4;                 // amplitudes of four channels share a cache line
} // namespace tiles

/// Modes of one rank, packed. Row i: `rank` pairs (sine, cosine part) of mode slots[i].
struct TileModes {
    const float* rows = nullptr;
    const std::int32_t* slots = nullptr;
    int count = 0;
    int rank = 0;
};

/// All modes of one layer. A mode's amplitudes: per four channels eight floats z = (re, im)... and eight
/// floats i z = (-im, re)..., so that multiplying by the carrier needs no shuffle.
struct TileLayer {
    std::array<TileModes, tiles::ranks.size()> modes;
    int channels = 0;
    int floatsPerSlot = 0;
    const float* amplitudes = nullptr;
    const float* carrierRe = nullptr; ///< by slot: the mode's phase and decay at the tile's first frame
    const float* carrierIm = nullptr;
    const float* basis = nullptr; ///< LowRankBasis::halves
};

/// Carriers of slots [0, count) and their factors for one tile.
struct TileCarriers {
    int count = 0;
    double *re = nullptr, *im = nullptr;
    const double *stepRe = nullptr, *stepIm = nullptr;
    float *roundedRe = nullptr, *roundedIm = nullptr;
};

/// What a complex number is multiplied by: unitPhasor(phase) * decayFactor(octaves).
struct Turn {
    std::uint64_t phase = 0;
    std::int64_t octaves = 0;
};

/// One strike inside a tile, of one mode: its amplitudes decay to the tile's first frame and gain scaled[j] *
/// onset in channel j, its carrier is set, and frame k >= from gains scaled[j] * im(onset * carrier * p^k).
struct TileStrike {
    const double* cosPowers = nullptr; ///< p^k, 64 of each
    const double* sinPowers = nullptr;
    double* amplitudes = nullptr; ///< re, im of each channel; readable in whole lines
    float* lines = nullptr;       ///< the same as TileLayer has them
    int slot = 0;
    int from = 0;
};

/// Strikes of one layer, none earlier than the one before it. Together they cost less: what they wait for is
/// waited for once, and the tails stay in registers.
struct TileStrikes {
    static constexpr int most = 8;
    int count = 0, channels = 0;
    std::array<TileStrike, most> each;
    std::array<std::uint64_t, most> onsetPhases{}, carrierPhases{};
    std::array<std::int64_t, most> onsetOctaves{}, decayOctaves{};
    const double* scaled = nullptr; ///< [strike * channels + channel]: amplitude times gain, twice
    double* tails = nullptr;        ///< [channel * 64 + frame], of all modes; on a cache line
    TileCarriers carriers;
};

} // namespace physvib
