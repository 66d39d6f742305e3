// SPDX-License-Identifier: MIT
// The board's sounding modes: per mode one decaying phasor w that turns by p each frame, and one complex amplitude
// z_j per channel; channel j of it is im(z_j w). A strike folds w into the amplitudes and lets w start at 1 again, so
// strikes of equal frequency and decay merge exactly, whatever their channels, at the cost of one mode.
//
// ModeBank does the same for a computer, from integers and for any number of channels; here everything is float, and
// small: 58 bytes a mode, four channels, four frames at a time. The order of every operation is fixed (no contraction),
// so that the board and a computer hold the same bits.
#pragma once
#include "Core/BoardEvent.h"
#include "Core/Trigonometry.h"
#include <array>
#include <cstdint>

namespace physvib {

/// All memory is inside the object. R only.
class PhasorBank {
public:
    static constexpr int channels = limits::board::channels;
    static constexpr int blockFrames = limits::board::blockFrames;
    static constexpr int capacity = limits::board::maxModes;
    using Block = std::array<std::array<float, static_cast<std::size_t>(blockFrames)>, static_cast<std::size_t>(channels)>;

    /// What the kernel reads.
    struct Mode {
        std::array<Complex<float>, static_cast<std::size_t>(channels)> amplitudes; // z_j
        Complex<float> phasor;                                                     // w at the next block's first frame
        Complex<float> turn;                                                       // p
    };

    /// Silence.
    void clear() noexcept;

    /// Writes the block that begins at `frame`, each of them right after the one before.
    void render(std::uint32_t frame, Block& out) noexcept;

    /// After render: adds an event that begins at frame `onset` of the block just written, to it and to what follows.
    void strike(const BoardEvent& event, std::uint32_t onset, Block& io) noexcept;

    int liveModes() const noexcept { return count_; }
    std::uint32_t stolenModes() const noexcept { return stolen_; }
    const Mode& mode(int i) const noexcept { return modes_[static_cast<std::size_t>(i)]; }

private:
    static constexpr auto slots = static_cast<std::size_t>(capacity);
    void renderModes(Block& io) noexcept;
    void renderResidue(Block& io) noexcept;
    void retire(Block& io) noexcept;
    void remove(int i) noexcept;
    int find(std::uint32_t key) const noexcept;
    int create(const BoardEvent& event, std::uint32_t key) noexcept;
    int quietest() const noexcept;
    void steal(int i) noexcept;
    void extend(int i, std::uint32_t end) noexcept;

    std::array<Mode, slots> modes_{};
    std::array<std::uint32_t, slots> keys_{};      // frequency16 and decay16: what merges
    std::array<std::uint32_t, slots> endFrames_{}; // from here on it is over
    std::array<bool, slots> gated_{};              // strikes with a duration are cut, so they do not merge
    std::array<float, static_cast<std::size_t>(channels)> residue_{}; // where stolen modes stood; decays without a step
    std::uint32_t frame_ = 0;                                         // first of the block last rendered
    std::uint32_t nextEnd_ = 0;                                       // no mode ends before this frame
    int count_ = 0;
    std::uint32_t stolen_ = 0;
};

} // namespace physvib
