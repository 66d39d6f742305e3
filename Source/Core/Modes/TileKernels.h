// SPDX-License-Identifier: MIT
// Interface of the vector kernels: limiter, guard sums, tiles of 64 frames of modes, measures of samples.
// Written once in TileKernels.cpp, compiled once per instruction set.
#pragma once
#include "Core/Limits.h"
#include "Core/Modes/InstructionSet.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib {

// Interface of the limiter's vector kernels: passes over part of a block, all channels at once, when no gain
// has to be computed or the gains are known.

/// Each channel has a line: from `front` on the frames of this part, then padding; before it `latency`
/// delayed ones. Lines and `front` are a multiple of the widest vector.
struct LimiterLines {
    const float* const* in = nullptr; ///< may be `out`
    float* const* out = nullptr;      ///< each from frame `first` on
    std::size_t first = 0, frames = 0, channels = 0;
    float* lines = nullptr;
    float* const* copy = nullptr; ///< if given, the inputs are copied there as well; null: no copy
    std::size_t floatsPerLine = 0, front = 0, latency = 0;

    float* line(std::size_t channel) const noexcept { return lines + channel * floatsPerLine; }
};

/// One instruction set's functions; the same bits as LinkedLimiter's own. Render thread (R), wait-free.
struct LimiterKernel {
    /// Writes the inputs behind the delayed frames, with denormals as 0, and unchanged to `copy`. True if a
    /// magnitude exceeds its channel's in `maxBits`.
    bool (*storeInputs)(const LimiterLines& lines, const std::int32_t* maxBits) = nullptr;
    /// Writes the delayed frames, as they are or times `gains` within the ceilings, and shifts the lines.
    void (*writeOutputs)(const LimiterLines& lines, const float* gains, const float* ceilings) = nullptr;
    /// OutputGuard's: sums[t * GuardUnits::stride + channel] of io[channel], in its units, over the t-th of
    /// `tiles` stretches of so many frames, one after another. `tiles`: 1 or GuardUnits::tiles. Null: no
    /// output.
    void (*sumTiles)(const float* const* io, std::size_t channels, std::size_t from, std::size_t frames,
                     std::size_t tiles, std::int32_t* sums) = nullptr;
};

/// A sample in the units that OutputGuard sums: 2^21 is full scale, so 64 frames of 8 times full scale fit.
struct GuardUnits {
    static constexpr std::size_t tiles = 4;   ///< summed together: at 48 kHz a block of 64 frames
    static constexpr std::size_t stride = 64; ///< channels, as many as there may be
    static constexpr float maxMagnitude = 8.0f, perFullScale = 2097152.0f;
    static std::int32_t fromSample(float x) noexcept {
        return static_cast<std::int32_t>(std::clamp(x, -maxMagnitude, maxMagnitude) * perFullScale);
    }
};

// Arguments of the vector kernels for one tile of 64 frames: modes, amplitudes, carriers, strikes.
//
// Low rank: inside a tile any decaying sinusoid of less than a turn or so is a combination of a few
// polynomials (LowRankBasis). A mode is a row of complex coefficients, fixed for life; a tile is the
// product of the modes' amplitudes with these rows, summed over modes, and one expansion per channel at the
// end, whatever the number of modes.

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

/// A complex factor: unitPhasor(phase) * decayFactor(octaves).
struct PhaseDecay {
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

/// Strikes of one layer, none earlier than the one before it. Together they cost less: memory is
/// waited for once, and the tails stay in registers.
struct TileStrikes {
    static constexpr int maxCount = 8;
    int count = 0, channels = 0;
    std::array<TileStrike, maxCount> entries;
    std::array<std::uint64_t, maxCount> onsetPhases{}, carrierPhases{};
    std::array<std::int64_t, maxCount> onsetOctaves{}, decayOctaves{};
    const double* scaled = nullptr; ///< [strike * channels + channel]: amplitude times gain, twice
    double* tails = nullptr;        ///< [channel * 64 + frame], of all modes; on a cache line
    TileCarriers carriers;
};
/// The largest magnitude of samples, and the sum of their squares.
struct Measured {
    float peak = 0.0f, squares = 0.0f;
};
/// Peaks and sums per lane of the widest vector. The last bits of the sums differ between instruction sets.
struct alignas(64) MeasuredLanes {
    float peaks[16]{}, squares[16]{};

    void add(float x) noexcept {
        const float magnitude = x < 0.0f ? -x : x;
        peaks[0] = peaks[0] < magnitude ? magnitude : peaks[0];
        squares[0] += x * x;
    }
};

/// One instruction set's functions. R, wait-free.
struct TileKernel {
    InstructionSet set = InstructionSet::scalar;
    void (*advance)(const TileCarriers& carriers) = nullptr;
    void (*render)(const TileLayer& layer, float* out) = nullptr; ///< out[channel * 64 + frame]
    void (*strike)(const TileStrikes& strikes) = nullptr;
    /// out = base + tails
    void (*sum)(const float* base, const double* tails, int count, float* out) = nullptr;
    void (*clear)(float* const* out, int channels, int frames) = nullptr; ///< out[channel][frame] = 0
    LimiterKernel limiter;
    /// Adds outputs[j][first, first + frames) to to[j] for up to 64 outputs; returns bit j where one is null.
    std::uint64_t (*measure)(const float* const* outputs, std::size_t count, std::size_t first,
                             std::size_t frames, MeasuredLanes* to) = nullptr;
    /// results[j] becomes the result of all lanes of lanes[j], which are set to 0
    void (*join)(MeasuredLanes* lanes, std::size_t count, Measured* results) = nullptr;
};

/// Null for scalar and for sets that this build or processor lacks. Any thread.
const TileKernel* tileKernel(InstructionSet set) noexcept;

} // namespace physvib
