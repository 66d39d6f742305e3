// SPDX-License-Identifier: MIT
// The output latency L as a formula: an event at world time w is played at w + L, and L is constant.
#pragma once
#include "Core/Limits.h"
#include <algorithm>
#include <cstdint>

namespace physvib {

/// What the output latency L has to cover.
struct ClockLaw {
    int sampleRateHz = 48000;       ///< of the audio device
    int blockFrames = 512;          ///< the largest block
    int stepsPerSecond = 100;       ///< of the physics world; 0: there is none
    double longestGapSeconds = 0.0; ///< longest time between two calls of the driver, which steps the world,
                                    ///< without an event being late
    int limiterFrames = 0;          ///< the renderer's own latency, part of L
    double sinkSeconds = 0.0; ///< the longest time by which a sink beside the renderer needs an event before
                              ///< it is played

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
/// ms; a thread with absolute deadlines exceeds its step by at most 1 ms on an ordinary kernel.
constexpr double messageTimerGapSeconds = 0.026;
constexpr double driverThreadGapSeconds = 0.001;

} // namespace physvib
