// SPDX-License-Identifier: MIT
// Counts rendered blocks and measures the share of their duration that rendering takes.
#pragma once
#include "Live/Session/Session.h"
#include <algorithm>
#include <chrono>
#include <cstdint>

namespace physvib {

class LoadMeter {
public:
    struct Load {
        std::uint64_t blocks = 0;
        float last = 0.0f, worst = 0.0f; ///< processing time / duration
    };

    using Clock = std::chrono::steady_clock;
    /// A block of `frames` that started at `start` has been rendered. R, wait-free.
    void take(Clock::time_point start, int frames, int sampleRateHz) noexcept {
        const std::chrono::duration<double> taken = Clock::now() - start;
        measured_.last = static_cast<float>(taken.count() * sampleRateHz / frames);
        measured_.worst = std::max(measured_.worst, measured_.last);
        ++measured_.blocks;
        load_.write(measured_);
    }

    /// M.
    Load read() noexcept { return load_.read(); }

private:
    LatestValue<Load> load_;
    Load measured_; // R
};

} // namespace physvib
