// SPDX-License-Identifier: MIT
// Interface of the vector kernels: what one computes for a tile of 64 frames, and the layout of the modes in
// memory. The kernels are written once in TileKernels.cpp and compiled per instruction set.
//
// Low rank: inside a tile any decaying sinusoid of less than about a turn is a combination of a few
// polynomials (LowRankBasis.h). A mode is a row of complex coefficients, fixed for its life. A tile is the
// product of the modes' amplitudes with these rows, summed over modes, and one expansion per channel at the
// end, whatever the number of modes.
#pragma once
#include "Core/Actuators/LimiterKernel.h"
#include "Core/Limits.h"
#include "Core/Modes/InstructionSet.h"
#include "Core/Trigonometry.h"
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib {

namespace tiles {
constexpr int frames = limits::tileFrames;         // small enough that one mode's values stay in registers
constexpr std::array<int, 4> ranks{8, 16, 32, 64}; // coefficients of a row; 64: the tile's frames themselves
constexpr int maxRank = 32;                        // largest number of polynomials
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

/// The complex factor unitPhasor(phase) * decayFactor(octaves).
struct Turn {
    std::uint64_t phase = 0;
    std::int64_t octaves = 0;
};

/// One strike of one mode inside a tile. The mode's amplitudes decay to the tile's first frame and scaled[j]
/// * onset is added in channel j; its carrier is set; scaled[j] * im(onset * carrier * p^k) is added to each
/// frame k >= from.
struct TileStrike {
    const double* cosPowers = nullptr; ///< p^k, 64 of each
    const double* sinPowers = nullptr;
    double* amplitudes = nullptr; ///< re, im of each channel; readable in whole cache lines
    float* lines = nullptr;       ///< the same in the layout of TileLayer
    int slot = 0;
    int from = 0;
};

/// Strikes of one layer in order of `from`. Processing them together is cheaper: their latencies overlap and
/// the tails stay in registers.
struct TileStrikes {
    static constexpr int most = 8;
    int count = 0, channels = 0;
    std::array<TileStrike, most> each;
    std::array<std::uint64_t, most> onsetPhases{}, carrierPhases{};
    std::array<std::int64_t, most> onsetOctaves{}, decayOctaves{};
    const double* scaled = nullptr; ///< [strike * channels + channel]: amplitude times gain, stored twice
    double* tails = nullptr;        ///< [channel * 64 + frame], of all modes; aligned to a cache line
    TileCarriers carriers;
};

/// One instruction set's functions. Render thread (R), wait-free.
struct TileKernel {
    InstructionSet set = InstructionSet::scalar;
    void (*advance)(const TileCarriers& carriers) = nullptr;
    void (*render)(const TileLayer& layer, float* out) = nullptr; ///< out[channel * 64 + frame]
    void (*strike)(const TileStrikes& strikes) = nullptr;
    /// out = base + tails
    void (*sum)(const float* base, const double* tails, int count, float* out) = nullptr;
    void (*clear)(float* const* out, int channels, int frames) = nullptr; ///< out[channel][frame] = 0
    LimiterKernel limiter;
};

/// Null for scalar and for sets that this build or processor lacks. Any thread.
const TileKernel* tileKernel(InstructionSet set) noexcept;

} // namespace physvib
