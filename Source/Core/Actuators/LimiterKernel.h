// SPDX-License-Identifier: MIT
// The limiter's passes over a part of a block, all channels at once, while nothing needs to be limited or the
// gains are known.
#pragma once
#include <cstddef>
#include <cstdint>

namespace physvib {

/// Each channel has a line: from `front` on the frames of this part, then padding; before it `latency`
/// delayed ones. Lines and `front` are a multiple of the widest vector.
struct LimiterLines {
    const float* const* in = nullptr; ///< may be `out`
    float* const* out = nullptr;      ///< each from frame `first` on
    std::size_t first = 0, frames = 0, channels = 0;
    float* lines = nullptr;
    float* const* kept = nullptr; ///< if given, where what comes in is written as well; null: nowhere
    std::size_t floatsPerLine = 0, front = 0, latency = 0;

    float* line(std::size_t channel) const noexcept { return lines + channel * floatsPerLine; }
};

/// One instruction set's functions; the same bits as LinkedLimiter's own. R, wait-free.
struct LimiterKernel {
    /// Puts what comes in behind the delayed frames, denormals as 0, and as it is where it is kept. True if a
    /// size is above its channel's in `mostBits`.
    bool (*take)(const LimiterLines& lines, const std::int32_t* mostBits) = nullptr;
    /// Writes the delayed frames times `gains` (null: 1), within the ceilings, and moves the lines on.
    void (*give)(const LimiterLines& lines, const float* gains, const float* ceilings) = nullptr;
};

} // namespace physvib
