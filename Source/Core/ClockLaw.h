// SPDX-License-Identifier: MIT
// The clocks of a session: from nanoseconds to frames, and the latency of the output.
#pragma once
#include "Core/Limits.h"
#include <algorithm>
#include <cstdint>

namespace physvib {

/// An onset on the frame grid. `frame` is the first one not before the onset, which is `leadFrames` earlier.
struct FramePosition {
    std::int64_t frame = 0;  ///< counted from 0
    double leadFrames = 0.0; ///< [0, 1)
};

/// Converts times to frames of one sample rate. Any thread.
class FrameClock {
public:
    /// `sampleRateHz` above 0.
    explicit FrameClock(int sampleRateHz = 48000) noexcept
        : rate_{sampleRateHz} {}

    /// `timeNs` from 0 to limits::maxTimeNs.
    FramePosition at(std::int64_t timeNs) const noexcept {
        const std::int64_t seconds = timeNs / nanosecondsPerSecond;
        const std::int64_t scaled = (timeNs % nanosecondsPerSecond) * rate_; // < 2e14: no overflow
        const std::int64_t missing =
            (nanosecondsPerSecond - scaled % nanosecondsPerSecond) % nanosecondsPerSecond;
        return {seconds * rate_ + (scaled + missing) / nanosecondsPerSecond,
                static_cast<double>(missing) * 1e-9};
    }

    /// The time of a number of frames, towards 0; of centuries without overflow.
    std::int64_t timeNs(std::int64_t frames) const noexcept {
        return frames / rate_ * nanosecondsPerSecond + frames % rate_ * nanosecondsPerSecond / rate_;
    }

    /// The constructor's argument.
    int sampleRateHz() const noexcept { return static_cast<int>(rate_); }

private:
    static constexpr std::int64_t nanosecondsPerSecond = 1'000'000'000;
    std::int64_t rate_;
};

/// What the output latency L has to cover: an event at world time w is played at w + L, and L is constant.
struct ClockLaw {
    int sampleRateHz = 48000;       ///< of the audio device
    int blockFrames = 512;          ///< the largest block
    int stepsPerSecond = 100;       ///< of the physics world; 0: there is none
    double longestGapSeconds = 0.0; ///< longest time between two calls of the driver, which steps the world,
                                    ///< without an event being late
    int limiterFrames = 0;          ///< the renderer's own latency, part of L
    double sinkSeconds = 0.0;       ///< the longest time before it is played at which a sink needs an event

    /// L in frames: one block (which is rendered at its beginning) + the longest gap + two steps (one that
    /// may not have begun, one in which events wait to be sorted) + the latency of the limiter or of the
    /// sinks, whichever is longer.
    std::int64_t outputLatencyFrames() const noexcept {
        const double seconds = longestGapSeconds + 2.0 * stepSeconds();
        return blockFrames + framesUp(seconds) + std::max<std::int64_t>(limiterFrames, framesUp(sinkSeconds));
    }
    /// Latency in frames of events that pass neither world nor sink: one block and the limiter.
    std::int64_t directFrames() const noexcept { return blockFrames + limiterFrames; }
    /// How far the world may lag behind session time without any of its events being late, even at the very
    /// end of a block: the longest gap and one step that may not have begun.
    std::int64_t safeLagNs() const noexcept {
        return static_cast<std::int64_t>((longestGapSeconds + stepSeconds()) * 1e9);
    }
    /// The same limit at the very beginning of a block, because session time advances by blocks. A driver
    /// that is in time never measures more.
    std::int64_t longestLagNs() const noexcept {
        return safeLagNs() + static_cast<std::int64_t>(1e9 * blockFrames / sampleRateHz);
    }
    double stepSeconds() const noexcept { return stepsPerSecond > 0 ? 1.0 / stepsPerSecond : 0.0; } ///< or 0
    /// L in seconds.
    double outputLatencySeconds() const noexcept {
        return static_cast<double>(outputLatencyFrames()) / sampleRateHz;
    }
    /// Seconds to frames, rounded up. Any thread.
    std::int64_t framesUp(double seconds) const noexcept {
        return static_cast<std::int64_t>(seconds * sampleRateHz + 0.999999);
    }
};

/// How long a driver may pause between two calls, as measured: a 10 ms JUCE timer under load pauses up to 26
/// ms; a thread that wakes when a step is due is at most 1 ms late on an ordinary kernel.
constexpr double messageTimerGapSeconds = 0.026;
constexpr double driverThreadGapSeconds = 0.001;

/// The gap of such a thread; negative, because L counts a step that has not begun, but here it has begun.
constexpr double threadGapSeconds(int stepsPerSecond, double lateSeconds = driverThreadGapSeconds) noexcept {
    return lateSeconds - 1.0 / stepsPerSecond;
}

} // namespace physvib
