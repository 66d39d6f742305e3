// SPDX-License-Identifier: MIT
// The mode bank's memory for vector kernels: rows by rank, rounded amplitudes, carriers, and the tile being
// played.
//
// A tile is made whole when its first frame is due; a strike inside it adds its own tail to the frames that
// are left, so it costs O(channels), not O(modes). Gated modes are a layer of their own: closing a gate
// renders that layer again and leaves the bits of the other alone (Docs/decisions/0002).
#pragma once
#include "Core/Modes/InstructionSet.h"
#include "Core/Modes/TileLayers.h"
#include "Core/Storage.h"
#include "Core/Trigonometry.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

class LowRankBasis;
struct TileKernel;

/// What a slot's mode is, as far as tiles need it. Powers: 64 of each, double precision, for as long as the
/// mode lives.
struct TileMode {
    const double* cosPowers = nullptr;
    const double* sinPowers = nullptr;
    double radiansPerFrame = 0.0; ///< |log p|
    Complex<double> tileFactor;   ///< p^64
    bool isGated = false;
};

/// R only, but for prepare: M. Off when there is no kernel.
class ModeTiles {
public:
    static constexpr int slotCount = limits::maxModes + limits::maxFadingModes;

    /// Nothing sounds; off, and without memory, if the set has no kernel here. At most slotCount slots.
    /// False: no memory for them.
    bool prepare(int channels, InstructionSet set, int slotsMost) noexcept;
    bool isOn() const noexcept { return kernel_ != nullptr; }
    InstructionSet set() const noexcept;

    void add(int slot, const TileMode& mode) noexcept;
    void remove(int slot) noexcept;

    /// The mode's phase and decay at the tile's first frame; its amplitudes, one per channel (readable in
    /// whole lines of tiles::channelsPerLine).
    void setCarrier(int slot, Complex<double> carrier) noexcept;
    void setAmplitudes(int slot, const Complex<double>* amplitudes) noexcept;

    /// The next tile: all carriers move on by one tile. Their errors grow by 1e-11 each time, so renew them
    /// in between.
    void advance() noexcept;
    /// Nothing of this tile is made yet.
    void begin() noexcept;
    /// How often: then an error is at most 3e-9.
    static constexpr int renewalTiles = 256;
    int slotsInUse() const noexcept { return highest_; }

    /// What this layer plays from that frame of the tile on follows from the amplitudes as they are when it
    /// is next needed.
    void redoFrom(bool isGated, int frame) noexcept;

    /// To be called before amplitudes change by a strike at `from`: what is to be redone is redone without
    /// it.
    void settle() noexcept;
    /// What a strike is turned by, and what its mode's carrier and amplitudes are brought to the tile's first
    /// frame by.
    struct StrikeTurns {
        Turn onset;
        std::uint64_t carrierPhase = 0;
        std::int64_t decayOctaves = 0;
    };
    /// Adds a strike from frame `from` of the tile on, there and to the mode's amplitudes. It may wait for
    /// others until finishStrikes.
    void strike(int slot, int from, const StrikeTurns& turns, double amplitude, const double* gains,
                Complex<double>* amplitudes) noexcept;
    /// To be called before amplitudes are read, or anything but strikes changes them.
    void finishStrikes() noexcept {
        if (strikes_.count > 0) strikeAll();
    }

    /// Where frames from `first` on of the tile stand, if each channel is one sum; else false, and render
    /// makes it.
    bool sumsAt(const float** at, int first) noexcept;
    /// out[j][0..frames) = frames [first, first + frames) of the tile. False if all of them are zero.
    bool render(float* const* out, int first, int frames) noexcept;

private:
    static constexpr std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
    static constexpr auto slots = static_cast<std::size_t>(slotCount);
    static constexpr auto padded = (slots + 7) / 8 * 8; // for the widest vector of doubles
    static constexpr auto width = static_cast<std::size_t>(limits::maxEnchanters);
    static constexpr auto frames = static_cast<std::size_t>(tiles::frames);
    static constexpr auto rankCount = tiles::ranks.size();
    template <class T, std::size_t most>
    using Room = Storage<T, most, true>;
    using PerSlot = Room<double, padded>;
    using RoundedPerSlot = Room<float, padded>;

    // Rows of one rank: those of free modes from the front, of gated ones from the back, each without gaps.
    struct Place {
        int rank = 0;
        int row = 0;
        TileMode mode;
        bool isUsed = false;
    };
    struct Layer {
        Room<float, width * frames> base;   // modes as of the tile's first frame
        Room<double, width * frames> tails; // strikes since then
        std::array<int, rankCount> counts{};
        int redo = tiles::frames;      // frames from here on are not made yet
        int tailsFrom = tiles::frames; // all of them are 0 before it
        bool hasBase = false;
        bool hasTails() const noexcept { return tailsFrom < tiles::frames; }
    };
    float* rowAt(std::size_t rank, int row) noexcept;
    int rowFor(bool isGated, int place) const noexcept { return isGated ? slots_ - 1 - place : place; }
    void make(Layer& layer, bool isGated) noexcept;
    TileLayer view(const Layer& layer, bool isGated) noexcept;
    TileCarriers carriers() noexcept {
        return {highest_,       re_.data(),        im_.data(),       stepRe_.data(),
                stepIm_.data(), roundedRe_.data(), roundedIm_.data()};
    }
    void addTails(const Layer& layer, float* const* out, int first, int count) const noexcept;
    bool takeMemory() noexcept;
    void sum(float* const* out, int first, int count) const noexcept;
    void strikeAll() noexcept;
    // the sum of free modes, or nothing
    bool isPlain() const noexcept {
        return !layers_[0].hasTails() && !layers_[1].hasTails() && !layers_[1].hasBase;
    }
    bool isEmpty() const noexcept {
        return highest_ == 0 && !layers_[0].hasBase && !layers_[1].hasBase && !layers_[0].hasTails() &&
               !layers_[1].hasTails();
    }

    static constexpr std::array<std::size_t, rankCount> floatsBefore = [] { // of rows of lower rank, per slot
        std::array<std::size_t, rankCount> offsets{};
        for (std::size_t r = 1; r < rankCount; ++r)
            offsets[r] = offsets[r - 1] + 2 * static_cast<std::size_t>(tiles::ranks[r - 1]);
        return offsets;
    }();
    static constexpr std::size_t rowFloats =
        floatsBefore.back() + 2 * static_cast<std::size_t>(tiles::ranks.back());

    const TileKernel* kernel_ = nullptr;
    const LowRankBasis* basis_ = nullptr;
    int slots_ = 0, channels_ = 0, floatsPerSlot_ = 0, highest_ = 0;
    Room<Place, slots> places_;
    std::array<Layer, 2> layers_; // free, gated
    TileStrikes strikes_;         // that wait, all of one layer
    bool areGated_ = false;
    Room<double, 2 * width * TileStrikes::most> scaled_;
    PerSlot re_, im_, stepRe_, stepIm_;
    RoundedPerSlot roundedRe_, roundedIm_;
    Room<float, slots * width * 4> amplitudes_;
    Room<float, slots * rowFloats> rows_;
    std::array<Room<std::int32_t, slots>, rankCount> rowSlots_;
};

} // namespace physvib
