// SPDX-License-Identifier: MIT
// OutputGuard at the device output, for every session that plays there, with its state readable by other
// threads.
#pragma once
#include "Core/Actuators/OutputGuard.h"
#include <atomic>
#include <utility>

namespace physvib {

class DeviceGuard {
public:
    /// M, while the device is stopped.
    void prepare(int sampleRateHz, int channels) noexcept {
        guard_.prepare(sampleRateHz, channels, GuardPlace::last);
    }
    /// As OutputGuard. R, wait-free.
    void process(float* const* io, int frames) noexcept {
        guard_.process(io, frames);
        gain_.store(guard_.gain(), std::memory_order_relaxed);
        episodes_.store(guard_.episodes(), std::memory_order_relaxed);
    }
    float gain() const noexcept { return gain_.load(std::memory_order_relaxed); } ///< any thread
    std::uint64_t episodes() const noexcept {
        return episodes_.load(std::memory_order_relaxed);
    } ///< any thread
    /// Whether `episodes`, the sum over this and other guards, has grown since the last call. M.
    bool hasNews(std::uint64_t episodes) noexcept { return std::exchange(told_, episodes) < episodes; }

private:
    OutputGuard guard_;
    std::atomic<float> gain_{1.0f};
    std::atomic<std::uint32_t> episodes_{0};
    std::uint64_t told_ = 0;
};

} // namespace physvib
