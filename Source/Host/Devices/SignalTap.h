// SPDX-License-Identifier: GPL-3.0-or-later
// Ring buffer that copies the output signals of a live session from the render thread to meters, scopes and
// files.
#pragma once
#include "Core/Nonblocking.h"
#include "Live/Session/Sink.h"
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <juce_core/juce_core.h>
#include <vector>

namespace physvib {

class SignalTap final : public Sink {
public:
    /// `frames`: capacity of each channel. M.
    SignalTap(int channels, int frames)
        : ring_(static_cast<std::size_t>(channels), std::vector<float>(static_cast<std::size_t>(frames)))
        , fifo_{frames}
        , heard_{channels} {}

    int channels() const noexcept { return static_cast<int>(ring_.size()); }

    /// Copies only the first `channels` from now on; the others keep their old samples. Any thread.
    void hear(int channels) noexcept {
        heard_.store(std::clamp(channels, 0, this->channels()), std::memory_order_relaxed);
    }

    void rendered(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override {
        take(block.channels, block.frames);
    }

    /// Frames that find the ring full are lost and counted. R, wait-free.
    void take(const float* const* channels, int frames) noexcept PHYSVIB_NONBLOCKING {
        const auto scope = fifo_.write(frames);
        const auto heard = static_cast<std::size_t>(heard_.load(std::memory_order_relaxed));
        for (std::size_t j = 0; j < heard; ++j) {
            std::copy_n(channels[j], scope.blockSize1, ring_[j].begin() + scope.startIndex1);
            std::copy_n(channels[j] + scope.blockSize1, scope.blockSize2,
                        ring_[j].begin() + scope.startIndex2);
        }
        const auto missing = static_cast<std::uint64_t>(frames - scope.blockSize1 - scope.blockSize2);
        lost_.store(lost_.load(std::memory_order_relaxed) + missing, std::memory_order_relaxed);
    }

    /// Calls `use(const float* const* channels, int frames)` with all unread frames, in one or two parts. One
    /// reader.
    template <class Use>
    void read(Use use) {
        const auto scope = fifo_.read(fifo_.getNumReady());
        std::vector<const float*> at(ring_.size());
        for (const auto& [start, size] :
             {std::pair{scope.startIndex1, scope.blockSize1}, {scope.startIndex2, scope.blockSize2}}) {
            if (size == 0) continue;
            for (std::size_t j = 0; j < ring_.size(); ++j) at[j] = ring_[j].data() + start;
            use(at.data(), size);
        }
    }

    std::uint64_t framesLost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
    std::vector<std::vector<float>> ring_;
    juce::AbstractFifo fifo_;
    std::atomic<int> heard_;
    std::atomic<std::uint64_t> lost_{0};
};

} // namespace physvib
