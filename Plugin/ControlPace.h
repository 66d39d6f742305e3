// SPDX-License-Identifier: GPL-3.0-or-later
// Rate limit for one kind of control change, so that automation cannot fill the session's control queue.
#pragma once
#include <algorithm>
#include <cstdint>

namespace physvib {

/// At most one control of a kind in so many frames of session time; of what comes faster the value then
/// present goes. The same whatever the block and L are, so that a bounce in blocks of another size is the
/// same samples. In frames of the session; R only.
class ControlPace {
public:
    static constexpr int perSecond = 1500; // every 32 frames at 48 kHz: gains move in ramps of 10 ms, worlds
                                           // in steps of 1 ms at least

    /// The frames between two. Any thread.
    static constexpr int framesAt(int sampleRateHz) noexcept { return std::max(1, sampleRateHz / perSecond); }

    /// Nothing has gone. M, or R.
    void reset(int sampleRateHz) noexcept {
        frames_ = framesAt(sampleRateHz);
        next_ = 0;
    }

    /// The first frame from `from` on at which the next may go.
    std::int64_t nextFrom(std::int64_t from) const noexcept { return std::max(from, next_); }
    void wentAt(std::int64_t frame) noexcept { next_ = frame + frames_; }

private:
    int frames_ = 1;
    std::int64_t next_ = 0;
};

} // namespace physvib
