// SPDX-License-Identifier: MIT
// Working memory of the mode bank for vector kernels: coefficient rows by rank, rounded amplitudes, carriers,
// and the current tile.
//
// A tile is rendered whole when its first frame is due. A strike inside it adds its own tail to the remaining
// frames, which costs O(channels), not O(modes). Gated modes are a separate layer: closing a gate renders
// that layer again and leaves the bits of the other unchanged (Docs/decisions/0001).
#pragma once
#include "Core/Modes/InstructionSet.h"
#include "Core/Modes/TileKernels.h"
#include "Core/Storage.h"
#include "Core/Trigonometry.h"
#include <array>
#include <cstdint>

namespace physvib {
class LowRankBasis;
struct TileKernel;

/// The properties of a slot's mode that tiles need. Powers: 64 of each, valid for as long as the mode lives.
struct TileMode {
    const double* cosPowers = nullptr;
    const double* sinPowers = nullptr;
    double radiansPerFrame = 0.0; ///< |log p|
    Complex<double> tileFactor;   ///< p^64
    bool isGated = false;
};

/// The bank's tiles; off when there is no kernel. Render thread (R) only; prepare: message thread (M).
class ModeTiles {
public:
    static constexpr int slotCount = limits::maxModes + limits::maxFadingModes;

    /// Silence; off, and without memory, if there is no kernel for the set. At most slotCount slots. False:
    /// no memory.
    bool prepare(int channels, InstructionSet set, int maxSlots) noexcept;
    bool isOn() const noexcept { return kernel_ != nullptr; }
    InstructionSet set() const noexcept;

    void add(int slot, const TileMode& mode) noexcept;
    void remove(int slot) noexcept;

    /// The mode's phase and decay at the tile's first frame, and its amplitudes, one per channel (readable in
    /// whole lines of tiles::channelsPerLine).
    void setCarrier(int slot, Complex<double> carrier) noexcept;
    void setAmplitudes(int slot, const Complex<double>* amplitudes) noexcept;

    /// Advances all carriers to the next tile. Errors grow by 1e-11 per call, so carriers must be renewed.
    void advance() noexcept;
    /// Starts a tile: none of it is rendered yet.
    void begin() noexcept;
    /// Tiles between renewals of a carrier: its error stays below 3e-9.
    static constexpr int renewalTiles = 256;
    int slotsInUse() const noexcept { return slotsInUse_; }

    /// The layer's samples from that frame of the tile on are to be rendered again, from the amplitudes as
    /// they are when the samples are next needed.
    void invalidateFrom(bool isGated, int frame) noexcept;

    /// To be called before a strike changes amplitudes: pending re-rendering is done without that strike.
    void settle() noexcept;
    /// Phase and decay by which a strike is turned at its onset; those of its mode's carrier; and the decay
    /// that brings the mode's amplitudes to the tile's first frame.
    struct StrikeTurns {
        PhaseDecay onset;
        std::uint64_t carrierPhase = 0;
        std::int64_t decayOctaves = 0;
    };
    /// Adds a strike from frame `from` of the tile on, to the tile and to the mode's amplitudes. It may be
    /// deferred until finishStrikes.
    void strike(int slot, int from, const StrikeTurns& turns, double amplitude, const double* gains,
                Complex<double>* amplitudes) noexcept;
    /// To be called before amplitudes are read, or are changed by anything but strikes.
    void finishStrikes() noexcept {
        if (strikes_.count > 0) flushStrikes();
    }

    /// Pointers to each channel's samples from frame `first` on of the tile, if each channel is a single sum.
    /// Otherwise false: use render.
    bool findSums(const float** sums, int first) noexcept;
    /// out[j][0..frames) = frames [first, first + frames) of the tile. False if all of them are zero.
    bool render(float* const* out, int first, int frames) noexcept;

private:
    static constexpr std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
    static constexpr auto slots = static_cast<std::size_t>(slotCount);
    static constexpr auto padded = (slots + 7) / 8 * 8; // for the widest vector of doubles
    static constexpr auto width = static_cast<std::size_t>(limits::maxActuators);
    static constexpr auto frames = static_cast<std::size_t>(tiles::frames);
    static constexpr auto rankCount = tiles::ranks.size();
    template <class T, std::size_t max>
    using Buffer = Storage<T, max, true>;
    using PerSlot = Buffer<double, padded>;
    using RoundedPerSlot = Buffer<float, padded>;

    // Rows of one rank: ungated modes from the front, gated ones from the back, each without gaps.
    struct SlotRow {
        int rank = 0;
        int row = 0;
        TileMode mode;
        bool isUsed = false;
    };
    struct Layer {
        Buffer<float, width * frames> base;   // modes as at the tile's first frame
        Buffer<double, width * frames> tails; // strikes since then
        std::array<int, rankCount> counts{};
        int staleFrom = tiles::frames; // frames from here on are not rendered yet
        int tailsFrom = tiles::frames; // tails are 0 before this frame
        bool hasBase = false;
        bool hasTails() const noexcept { return tailsFrom < tiles::frames; }
    };
    float* rowAt(std::size_t rank, int row) noexcept;
    int rowFor(bool isGated, int place) const noexcept { return isGated ? slots_ - 1 - place : place; }
    void renderLayer(Layer& layer, bool isGated) noexcept;
    TileLayer view(const Layer& layer, bool isGated) noexcept;
    TileCarriers carriers() noexcept {
        return {slotsInUse_,    re_.data(),        im_.data(),       stepRe_.data(),
                stepIm_.data(), roundedRe_.data(), roundedIm_.data()};
    }
    void addTails(const Layer& layer, float* const* out, int first, int count) const noexcept;
    bool allocate() noexcept;
    void sum(float* const* out, int first, int count) const noexcept;
    void flushStrikes() noexcept;
    // the output is the sum of ungated modes, or silence
    bool isPlain() const noexcept {
        return !layers_[0].hasTails() && !layers_[1].hasTails() && !layers_[1].hasBase;
    }
    bool isEmpty() const noexcept {
        return slotsInUse_ == 0 && !layers_[0].hasBase && !layers_[1].hasBase && !layers_[0].hasTails() &&
               !layers_[1].hasTails();
    }

    static constexpr std::array<std::size_t, rankCount> rankOffsets = [] { // offset of a rank's rows, per
                                                                           // slot
        std::array<std::size_t, rankCount> offsets{};
        for (std::size_t r = 1; r < rankCount; ++r)
            offsets[r] = offsets[r - 1] + 2 * static_cast<std::size_t>(tiles::ranks[r - 1]);
        return offsets;
    }();
    static constexpr std::size_t rowFloats =
        rankOffsets.back() + 2 * static_cast<std::size_t>(tiles::ranks.back());

    const TileKernel* kernel_ = nullptr;
    const LowRankBasis* basis_ = nullptr;
    int slots_ = 0, channels_ = 0, floatsPerSlot_ = 0, slotsInUse_ = 0;
    Buffer<SlotRow, slots> slotRows_;
    std::array<Layer, 2> layers_; // ungated, gated
    TileStrikes strikes_;         // deferred strikes, all of one layer
    bool areStrikesGated_ = false;
    Buffer<double, 2 * width * TileStrikes::maxCount> scaledGains_;
    PerSlot re_, im_, stepRe_, stepIm_;
    RoundedPerSlot roundedRe_, roundedIm_;
    Buffer<float, slots * width * 4> amplitudes_;
    Buffer<float, slots * rowFloats> rows_;
    std::array<Buffer<std::int32_t, slots>, rankCount> rowSlots_;
};

/// Orthonormal polynomials on the 64 frames of a tile (discrete Chebyshev, or Gram, polynomials). Decaying
/// sinusoids of low frequency are well approximated by a few of them. Nested: a mode of rank 8 uses the first
/// 8 of 32. Polynomial k is even about the middle of the tile for even k, odd for odd k; so half of each is
/// stored.
class LowRankBasis {
public:
    LowRankBasis() noexcept;

    /// [k * 32 + t]: polynomial k at frame t < 32, in the order in which the kernels read it.
    const float* halves() const noexcept { return halves_.data(); }

    /// row[2k], row[2k + 1]: sine and cosine part of p^t along polynomial k < rank. With rank 64: the powers
    /// themselves.
    void project(const double* cosPowers, const double* sinPowers, int rank, float* row) const noexcept;

    /// The smallest of tiles::ranks whose error for this mode is below 2e-7 of its amplitude, rounding to
    /// float included. `radians`: |log p|, by how much the mode turns and decays per frame.
    static int rankFor(double radians) noexcept;

private:
    static constexpr auto half = static_cast<std::size_t>(tiles::frames / 2);
    static constexpr auto maxRank = static_cast<std::size_t>(tiles::maxRank);
    std::array<double, maxRank * half> values_{};
    alignas(64) std::array<float, maxRank * half> halves_{}; // aligned, because kernels load whole vectors
};

} // namespace physvib
