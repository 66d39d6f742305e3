// SPDX-License-Identifier: MIT
// Estimates offset and drift of the board's clock from pings.
//
// A ping is sent at a, the board reads its clock b, the answer arrives at c. So the board's clock at a is at
// most b, and at c at least b: plotted over the computer's time, all points (a, b) lie above the clock's
// line, all (c, b) below it. For a drift d, the distance between the two envelopes is the round trip of the
// fastest pings; a wrong drift tilts the points and makes it smaller. The distance is a concave function of
// d: its maximum gives the drift, the middle between the envelopes the offset. A mean or a least-squares line
// would be biased by the random delays; the envelopes depend on the fastest pings only.
#pragma once
#include "Core/Limits.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// Converts the computer's time to the board's frames. One thread.
class LinkClock {
public:
    /// Pings that are kept: 26 s at 10 a second. The drift of a warming crystal is constant for so long.
    static constexpr int window = 256;
    /// Pings before the estimate is used: the first 2 s, at 50 a second. With 64 an error of 3 ms was seen.
    static constexpr int minPings = 100;
    static constexpr double maxDrift = 0.02; // of the board's internal oscillator: 1 % plus temperature

    void clear() noexcept { count_ = next_ = 0; }
    bool isEmpty() const noexcept { return count_ == 0; }

    /// Extends the board's 32-bit frame counter, which wraps after 6.2 days. For the next `add`.
    double unwrappedFrame(std::uint32_t frame, std::uint8_t fraction) const noexcept {
        const auto sinceLast = static_cast<std::int32_t>(frame - static_cast<std::uint32_t>(lastFrame_));
        return static_cast<double>(isEmpty() ? frame : lastFrame_ + sinceLast) + fraction / 256.0;
    }

    /// A ping sent at `sentNs`, answered with the board's clock `boardFrames`, received at `receivedNs`.
    void add(std::int64_t sentNs, double boardFrames, std::int64_t receivedNs) noexcept {
        if (count_ == 0) origin_ = {sentNs, boardFrames};
        points_[static_cast<std::size_t>(next_)] = {seconds(sentNs), (boardFrames - origin_.frames) / rate,
                                                    seconds(receivedNs)};
        lastFrame_ = static_cast<std::int64_t>(boardFrames);
        next_ = (next_ + 1) % window;
        count_ = std::min(count_ + 1, window);
        estimate();
    }

    bool isReady() const noexcept { return count_ >= minPings; }

    /// The board's frame, usually fractional, at the computer's time `ns`.
    double frameAt(std::int64_t ns) const noexcept {
        return origin_.frames + (offset_ + seconds(ns) * (1.0 + drift_)) * rate;
    }

    /// Relative to the computer's clock: 1e-6 is one ppm.
    double drift() const noexcept { return drift_; }

    /// The longest delay to the board among the stored pings; the output latency has to cover it.
    double worstDelaySeconds() const noexcept {
        double longest = 0.0;
        for (int i = 0; i < count_; ++i)
            longest = std::max(longest, point(i).board - (offset_ + point(i).sent * (1.0 + drift_)));
        return longest;
    }

    /// Maximum error of the offset, if delays stay within those seen.
    double uncertaintySeconds() const noexcept { return offsetBounds(drift_).width() / 2.0; }

private:
    static constexpr double rate = limits::board::sampleRateHz;
    struct Point {
        double sent = 0.0, board = 0.0, received = 0.0; // seconds since the origin
    };
    struct OffsetBounds {
        double upper = 0.0, lower = 0.0; // bounds of the offset
        double width() const noexcept { return upper - lower; }
    };
    double seconds(std::int64_t ns) const noexcept { return static_cast<double>(ns - origin_.ns) * 1e-9; }
    const Point& point(int i) const noexcept { return points_[static_cast<std::size_t>(i)]; }

    OffsetBounds offsetBounds(double drift) const noexcept {
        OffsetBounds bounds{1e300, -1e300};
        for (int i = 0; i < count_; ++i) {
            bounds.upper = std::min(bounds.upper, point(i).board - point(i).sent * (1.0 + drift));
            bounds.lower = std::max(bounds.lower, point(i).board - point(i).received * (1.0 + drift));
        }
        return bounds;
    }

    void estimate() noexcept {
        double low = -maxDrift, high = maxDrift;
        for (int i = 0; i < 40 && isReady(); ++i) { // ternary search: 0.02 becomes 2e-9
            const double third = (high - low) / 3.0;
            if (offsetBounds(low + third).width() < offsetBounds(high - third).width())
                low += third;
            else
                high -= third;
        }
        drift_ = isReady() ? (low + high) / 2.0 : 0.0;
        const OffsetBounds bounds = offsetBounds(drift_);
        offset_ = (bounds.upper + bounds.lower) / 2.0;
    }

    struct Origin {
        std::int64_t ns = 0;
        double frames = 0.0;
    };
    Origin origin_;
    std::array<Point, static_cast<std::size_t>(window)> points_{};
    std::int64_t lastFrame_ = 0; // frame of the newest ping
    int count_ = 0, next_ = 0;
    double offset_ = 0.0, drift_ = 0.0;
};

} // namespace physvib
