// SPDX-License-Identifier: MIT
// Frames on their way from the renderer to the converters, and the clock that counts them.
#pragma once
#include "Core/BoardRenderer.h"
#include "DacBus.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib::board {

/// The main loop puts blocks in, the timer interrupt takes frames out.
class Outputs {
public:
    static constexpr std::uint32_t aheadFrames = 16; // 2 ms: a block may take four times its time once

    bool hasRoom() const noexcept { return rendered_ - played_ <= aheadFrames - BoardRenderer::blockFrames; }

    /// Only when hasRoom. Main loop.
    void put(const BoardRenderer::Codes& block) noexcept {
        for (const auto& frame : block) {
            frames_[rendered_ % size] = frame;
            asm volatile("" ::: "memory"); // first the frame, then the word of it
            rendered_ = rendered_ + 1;
        }
    }

    /// What is ahead becomes quieter by half each frame: silent within a millisecond. Main loop.
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

    /// Timer interrupt.
    void playNext() noexcept {
        if (played_ != rendered_) {
            DacBus::put(frames_[played_ % size]);
            played_ = played_ + 1;
        } else {
            missed_ = missed_ + 1; // the converters hold the last frame; the clock stands still
        }
    }

    std::uint32_t played() const noexcept { return played_; }
    std::uint32_t missed() const noexcept { return missed_; }

private:
    static constexpr std::uint32_t size = 32; // a power of two: frame numbers wrap
    alignas(4) std::array<DacBus::Frame, size> frames_{};
    volatile std::uint32_t rendered_ = 0, played_ = 0, missed_ = 0;
};

} // namespace physvib::board
