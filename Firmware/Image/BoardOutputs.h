// SPDX-License-Identifier: MIT
// DacBus writes frames to the converters, and FrameQueue queues them. The count of played frames is the
// board's clock.
#pragma once
#include "Core/BoardRenderer.h"
#include "Registers.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib::board {

// Drives the two dual converters TLC7528 on port C: eight data lines, latch select, write, two chip selects.
//
// Times assumed for the TLC7528 at 5 V (unverified: Docs/board.md): chip and latch select 50 ns before the
// write, data 25 ns before its end, write pulse 50 ns, data and select held 10 ns after it. One cycle at 72
// MHz is 13.9 ns. The latches are transparent while the write line is low: a select line that changes then
// would write the code to the wrong channel.

/// Wiring, port C: PC0-PC7 data, PC8 latch (0: A, 1: B), PC9 /WR, PC10 and PC11 /CS of converters 1 and 2.
class DacBus {
public:
    using Frame = std::array<std::uint8_t, 4>; ///< channels 1 A, 1 B, 2 A, 2 B
    static constexpr std::uint8_t midScale = 128;

    /// Sets the lines inactive, then writes mid-scale.
    static void start() noexcept {
        reg(gpio::c + gpio::bsrr) = write | chip1 | chip2;
        reg(gpio::c + gpio::moder) = (reg(gpio::c + gpio::moder) & 0xFF000000u) | 0x00555555u;
        reg(gpio::c + gpio::ospeedr) |= 0x00FFFFFFu; // edges of a few ns
        silence();
    }

    /// Writes a frame in about 1 us. Timer interrupt only, except for silence().
    static void writeFrame(const Frame& frame) noexcept {
        writeCode(frame[0], chip1, 0);
        writeCode(frame[1], chip1, latch);
        writeCode(frame[2], chip2, 0);
        writeCode(frame[3], chip2, latch);
        reg(gpio::c + gpio::bsrr) = chip1 | chip2;
    }

    /// May be called from anywhere, even a fault handler: needs no memory and no other interrupt.
    static void silence() noexcept { writeFrame({midScale, midScale, midScale, midScale}); }

private:
    static constexpr std::uint32_t latch = 1u << 8, write = 1u << 9, chip1 = 1u << 10, chip2 = 1u << 11;

    // A read of the port waits for the writes before it and takes two cycles, or one directly after another
    // read: at least 69 ns in total at 72 MHz.
    static void settle() noexcept {
        for (int i = 0; i < 4; ++i) [[maybe_unused]] const std::uint32_t state = reg(gpio::c + gpio::odr);
    }

    static void writeCode(std::uint8_t code, std::uint32_t chip, std::uint32_t select) noexcept {
        const std::uint32_t highLines = code | select | (chip1 ^ chip2 ^ chip);
        const std::uint32_t lines = 0xFFu | latch | chip1 | chip2;
        reg(gpio::c + gpio::bsrr) = highLines | (lines & ~highLines) << 16;
        settle();
        reg(gpio::c + gpio::bsrr) = write << 16;
        settle();
        reg(gpio::c + gpio::bsrr) = write; // the next change of a line comes at least two cycles later: 28 ns
        [[maybe_unused]] const std::uint32_t state = reg(gpio::c + gpio::odr);
    }
};

/// Queue of frames: the main loop adds blocks, the timer interrupt writes frames to the converters.
class FrameQueue {
public:
    static constexpr std::uint32_t aheadFrames = 16; // 2 ms: rendering a block may take that long

    bool hasRoom() const noexcept { return rendered_ - played_ <= aheadFrames - BoardRenderer::blockFrames; }

    /// Requires hasRoom(). Main loop.
    void add(const BoardRenderer::Codes& block) noexcept {
        for (const auto& frame : block) {
            frames_[rendered_ % capacityFrames] = frame;
            asm volatile("" ::: "memory"); // store the frame before its count
            rendered_ = rendered_ + 1;
        }
    }

    /// Halves the level of the queued frames from one to the next: silent within a millisecond. Main loop.
    void fadeOut() noexcept {
        int shift = 1;
        for (std::uint32_t n = played_ + 1; static_cast<std::int32_t>(rendered_ - n) > 0; ++n, ++shift) {
            DacBus::Frame frame = frames_[n % capacityFrames];
            for (auto& code : frame)
                code = static_cast<std::uint8_t>(DacBus::midScale +
                                                 (code - DacBus::midScale) / (1 << std::min(shift, 8)));
            frames_[n % capacityFrames] = frame;
        }
    }

    /// Called by the timer interrupt.
    void playNext() noexcept {
        if (played_ != rendered_) {
            DacBus::writeFrame(frames_[played_ % capacityFrames]);
            played_ = played_ + 1;
        } else {
            missedFrames_ = missedFrames_ + 1; // the converters hold the last frame, and the clock stops
        }
    }

    std::uint32_t played() const noexcept { return played_; }
    std::uint32_t missedFrames() const noexcept { return missedFrames_; }

private:
    static constexpr std::uint32_t capacityFrames = 32; // a power of two, because frame numbers wrap
    alignas(4) std::array<DacBus::Frame, capacityFrames> frames_{};
    volatile std::uint32_t rendered_ = 0, played_ = 0, missedFrames_ = 0;
};

} // namespace physvib::board
