// SPDX-License-Identifier: MIT
// Offline rendering of all events of a source, from frame 0 on, with the renderer's latency removed.
#pragma once
#include "Core/HapticRenderer.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib {

/// Renders frames 0 to `frames` of a renderer that has just been prepared, in blocks of `blockFrames`. Each
/// block is written to out[channel] and passed to `consume(channels, n)`, the next n frames in order, until
/// it returns false. The limiter's look-ahead is rendered first and dropped, so that frame n is time n/rate.
/// On the thread that owns the renderer.
template <class Source, class Consume>
void renderFromStart(HapticRenderer& renderer, Source& source, float* const* out, int channels,
                     std::int64_t frames, int blockFrames, Consume&& consume) {
    std::array<float*, static_cast<std::size_t>(limits::maxEnchanters)> kept{};
    const std::int64_t latency = renderer.latencyFrames(), end = frames + latency;
    for (std::int64_t done = 0; done < end;) {
        const int block = static_cast<int>(std::min<std::int64_t>(blockFrames, end - done));
        renderer.render(source, out, block);
        const int dropped = static_cast<int>(std::clamp<std::int64_t>(latency - done, 0, block));
        for (int j = 0; j < channels; ++j) kept[static_cast<std::size_t>(j)] = out[j] + dropped;
        done += block;
        if (block > dropped && !consume(static_cast<const float* const*>(kept.data()), block - dropped))
            break;
    }
}

} // namespace physvib
