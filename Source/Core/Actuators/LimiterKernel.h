// SPDX-License-Identifier: MIT
// Interface of the limiter's vector kernels: passes over part of a block, all channels at once, when no gain
// has to be computed or the gains are known.
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
    float* const* kept = nullptr; ///< if given, the inputs are copied there as well; null: no copy
    std::size_t floatsPerLine = 0, front = 0, latency = 0;

    float* line(std::size_t channel) const noexcept { return lines + channel * floatsPerLine; }
};

/// One instruction set's functions; the same bits as LinkedLimiter's own. Render thread (R), wait-free.
struct LimiterKernel {
    /// Writes the inputs behind the delayed frames, with denormals as 0, and unchanged to `kept`. True if a
    /// magnitude exceeds its channel's in `mostBits`.
    bool (*take)(const LimiterLines& lines, const std::int32_t* mostBits) = nullptr;
    /// Writes the delayed frames times `gains` (null: 1), within the ceilings, and shifts the lines.
    void (*give)(const LimiterLines& lines, const float* gains, const float* ceilings) = nullptr;
};

} // namespace physvib
