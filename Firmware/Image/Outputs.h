// SPDX-License-Identifier: MIT
// Queue of frames between renderer and converters; its count of frames is the board's clock.
#pragma once
#include "Core/BoardRenderer.h"
#include "DacBus.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib::board {

/// The main loop adds blocks, the timer interrupt removes frames.
class Outputs {
public:
    static constexpr std::uint32_t aheadFrames = 16; // 2 ms: one block may take four times its duration

    bool hasRoom() const noexcept { return rendered_ - played_ <= aheadFrames - BoardRenderer::blockFrames; }

    /// Requires hasRoom(). Main loop.
    void put(const BoardRenderer::Codes& block) noexcept {
        for (const auto& frame : block) {
            frames_[rendered_ % size] = frame;
            asm volatile("" ::: "memory"); // store the frame before its count
            rendered_ = rendered_ + 1;
        }
    }

    /// Halves the level of the queued frames from one to the next: silent within a millisecond. Main loop.
    void fadeOut() noexcept {
        int shift = 1;
        for (std::uint32_t n = played_ + 1; static_cast<std::int32_t>(rendered_ - n) > 0; ++n, ++shift) {
            DacBus::Frame frame = frames_[n % size];
            for (auto& code : frame)
                code = static_cast<std::uint8_t>(DacBus::midScale +
                                                 (code - DacBus::midScale) / (1 << std::min(shift, 8)));
            frames_[n % size] = frame;
        }
    }

    /// Called by the timer interrupt.
    void playNext() noexcept {
        if (played_ != rendered_) {
            DacBus::put(frames_[played_ % size]);
            played_ = played_ + 1;
        } else {
            missed_ = missed_ + 1; // the converters hold the last frame, and the clock stops
        }
    }

    std::uint32_t played() const noexcept { return played_; }
    std::uint32_t missed() const noexcept { return missed_; }

private:
    static constexpr std::uint32_t size = 32; // a power of two, because frame numbers wrap
    alignas(4) std::array<DacBus::Frame, size> frames_{};
    volatile std::uint32_t rendered_ = 0, played_ = 0, missed_ = 0;
};

} // namespace physvib::board
