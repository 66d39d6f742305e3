// SPDX-License-Identifier: MIT
// The one clock law, as numbers: what is born at world time w is played at w + L, and L is a constant.
#pragma once
#include "Core/FrameClock.h"
#include "Core/Limits.h"
#include <algorithm>
#include <cstdint>

namespace physvib {

/// What the play-out delay L has to cover.
struct ClockLaw {
    int sampleRateHz = 48000;       ///< of the device
    int blockFrames = 512;          ///< the largest block
    int stepsPerSecond = 100;       ///< of the world
    double longestGapSeconds = 0.0; ///< between two calls of the driver that are still in time
    int limiterFrames = 0;          ///< the renderer's own latency, part of L
    double sinkSeconds = 0.0; ///< how long before it is felt a sink beside the renderer has to know an event,
                              ///< at most

    /// L in frames: a block (which is rendered at its beginning) + the longest gap + two steps (the one that
    /// may not have begun, and the one that events wait to be sorted) + the limiter or the sinks, whichever
    /// takes longer.
    std::int64_t playOutFrames() const noexcept {
        const double seconds = longestGapSeconds + 2.0 / stepsPerSecond;
        return blockFrames + framesUp(seconds) + std::max<std::int64_t>(limiterFrames, framesUp(sinkSeconds));
    }
    /// The same of what needs neither world nor sink: the block in which it comes, and the limiter.
    std::int64_t directFrames() const noexcept { return blockFrames + limiterFrames; }
    /// How far behind session time the world may be so that whatever it makes until it has caught up comes in
    /// time, even at the very end of a block: the longest gap and the step that may not have begun.
    std::int64_t safeLagNs() const noexcept {
        return static_cast<std::int64_t>((longestGapSeconds + 1.0 / stepsPerSecond) * 1e9);
    }
    /// The same at the very beginning of a block, since session time jumps by blocks: a driver that is in
    /// time never sees more.
    std::int64_t longestLagNs() const noexcept {
        return safeLagNs() + static_cast<std::int64_t>(1e9 * blockFrames / sampleRateHz);
    }
    /// L.
    double playOutSeconds() const noexcept { return static_cast<double>(playOutFrames()) / sampleRateHz; }
    /// Any thread.
    std::int64_t framesUp(double seconds) const noexcept {
        return static_cast<std::int64_t>(seconds * sampleRateHz + 0.999999);
    }
};

/// How long a driver may be silent and still be in time, as measured: a JUCE timer of 10 ms under load waits
/// up to 26 ms, an own thread with absolute deadlines at most a millisecond beyond its step on an ordinary
/// kernel.
constexpr double messageTimerGapSeconds = 0.026;
constexpr double driverThreadGapSeconds = 0.001;

} // namespace physvib
