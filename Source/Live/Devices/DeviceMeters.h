// SPDX-License-Identifier: MIT
// What an output measures of its device: load, blocks that stay away, levels.
#pragma once
#include "Core/Limits.h"
#include "Live/Session/DevicePulse.h"
#include "Live/Session/Session.h"
#include <algorithm>
#include <array>
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

// Detects that a device has stopped asking for blocks, because some drivers do not report that a device has
// gone.

/// M.
class DeviceWatch {
public:
    using Clock = std::chrono::steady_clock;

    /// A device that asks for no block during this time counts as gone; the longest block lasts 1.6 s (8192
    /// frames at 5 kHz).
    static constexpr std::chrono::nanoseconds patience{DevicePulse::goneNs};

    /// Whether the device has gone; call about once a second. `blocks`: number the device has asked for so
    /// far. `isIdle`: the device has no reason to ask. If more than `patience` passed since the last call,
    /// the program was paused together with the device, and the watch restarts.
    bool hasGone(Clock::time_point now, std::uint64_t blocks, bool isIdle) noexcept {
        const bool wasAway = now - lookedAt_ > patience;
        if (blocks != blocks_ || isIdle || wasAway) movedAt_ = now;
        blocks_ = blocks;
        lookedAt_ = now;
        return now - movedAt_ > patience;
    }

    /// Counts a loss, and watches the device that runs now.
    void lose(Clock::time_point now) noexcept {
        movedAt_ = lookedAt_ = now;
        ++losses_;
    }
    int losses() const noexcept { return losses_; }

private:
    int losses_ = 0;
    std::uint64_t blocks_ = 0;
    Clock::time_point movedAt_, lookedAt_; // zero before the first call
};

// Meter values of the outputs, for the views of plug-in and mixer.

struct ChannelMeters {
    std::array<float, limits::maxEnchanters> peaks{}; ///< 1 = full scale; falling by `meterFallDbPerSecond`
    std::array<bool, limits::maxEnchanters> isConnected{};
    int enchanters = 0;
    int connected = 0;
    float limiterGain = 1.0f;
    float guardGain = 1.0f; ///< of the channel that OutputGuard attenuates most
};

constexpr double meterFallDbPerSecond = 20.0;

} // namespace physvib
