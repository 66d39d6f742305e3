// SPDX-License-Identifier: MIT
// The mode bank of the four-channel board. A mode is one decaying phasor w that is multiplied by p each
// frame: im(w) is the signal of its loudest channel; each other channel is w times a constant complex ratio.
// A strike adds to all four channels and the loudest is chosen anew, so strikes of equal frequency and decay
// merge exactly, whatever their channels, at the cost of one mode.
//
// ModeBank does the same for a computer, from integers and for any number of channels. Here everything is
// float and small: 49 bytes per mode, four channels, four frames at a time. The order of every operation is
// fixed (no contraction), so that the board and a computer compute the same bits.
#pragma once
#include "Core/BoardEvent.h"
#include "Core/Trigonometry.h"
#include <array>
#include <cstdint>

namespace physvib {

/// The board's sounding modes. All memory is inside the object. Render thread (R) only.
class PhasorBank {
public:
    static constexpr int channels = limits::board::channels;
    static constexpr int blockFrames = limits::board::blockFrames;
    static constexpr int capacity = limits::board::maxModes;
    using Row = std::array<float, static_cast<std::size_t>(blockFrames)>; ///< of one channel
    using Block = std::array<Row, static_cast<std::size_t>(channels)>;

    /// Data that the kernel reads. If channel c is the loudest, ratio i belongs to channel i + 1, except
    /// ratio c - 1, which belongs to channel 0.
    struct Mode {
        std::array<Complex<float>, static_cast<std::size_t>(channels - 1)> ratios;
        Complex<float> phasor; // w at the next block's first frame
        Complex<float> turn;   // p
    };

    void clear() noexcept; ///< Silence.

    /// Writes the block that begins at `frame`; blocks are consecutive.
    void render(std::uint32_t frame, Block& out) noexcept;

    /// After render: adds an event with its onset at frame `onset` of the block just written, to that block
    /// and to later ones.
    void strike(const BoardEvent& event, std::uint32_t onset, Block& io) noexcept;

    int liveModes() const noexcept { return ends_.back(); }
    std::uint32_t stolenModes() const noexcept { return stolen_; }
    const Mode& mode(int i) const noexcept { return modes_[static_cast<std::size_t>(i)]; }

private:
    using Phasors = std::array<Complex<float>, static_cast<std::size_t>(channels)>;
    static constexpr auto slots = static_cast<std::size_t>(capacity);
    static void renderModes(Mode* from, const Mode* to, Row& loudest, Row& b, Row& c, Row& d) noexcept;
    void renderResidue(Block& io) noexcept;
    void retire(Block& io) noexcept;
    int groupOf(int i) const noexcept;
    int insertSlot(int group) noexcept;
    void removeMode(int i) noexcept;
    void moveMode(int target, int source) noexcept;
    int find(std::uint32_t key) const noexcept;
    int create(const BoardEvent& event, std::uint32_t key) noexcept;
    int quietest() const noexcept;
    void steal(int i) noexcept;
    Phasors phasorsOf(int i) const noexcept;
    int setPhasors(int i, const Phasors& phasors) noexcept;
    void setEnd(int i, std::uint32_t end) noexcept;

    std::array<Mode, slots> modes_{};              // sorted by loudest channel
    std::array<std::uint32_t, slots> keys_{};      // frequency16 and decay16: the merge key
    std::array<std::uint32_t, slots> endFrames_{}; // first frame after the mode's end
    std::array<bool, slots> isGated_{};            // strikes with a duration are cut, so they do not merge
    // modes whose loudest is channel c end before slot ends_[c]
    std::array<int, static_cast<std::size_t>(channels)> ends_{};
    // values of stolen modes, which decay to 0 without a step
    std::array<float, static_cast<std::size_t>(channels)> residue_{};
    std::uint32_t frame_ = 0;   // first of the block last rendered
    std::uint32_t nextEnd_ = 0; // no mode ends before this frame
    std::uint32_t stolen_ = 0;
};

} // namespace physvib
