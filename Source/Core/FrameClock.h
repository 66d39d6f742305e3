// SPDX-License-Identifier: MIT
// Converts session time in nanoseconds to sample frames, exactly: integers only, at any sample rate.
#pragma once
#include <cstdint>

namespace physvib {

/// An onset on the frame grid. `frame` is the first frame not earlier than the onset, which lies `leadFrames`
/// before it.
struct FramePosition {
    std::int64_t frame = 0;
    double leadFrames = 0.0; ///< [0, 1)
};

/// Converts times to frames of one sample rate. Any thread.
class FrameClock {
public:
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

    int sampleRateHz() const noexcept { return static_cast<int>(rate_); }

private:
    static constexpr std::int64_t nanosecondsPerSecond = 1'000'000'000;
    std::int64_t rate_;
};

} // namespace physvib
