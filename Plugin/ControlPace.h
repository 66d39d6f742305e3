// SPDX-License-Identifier: GPL-3.0-or-later
// How often one kind of control goes to the session, so that automation never fills the room of those that must not wait.
#pragma once
#include <algorithm>
#include <cstdint>

namespace physvib {

/// Controls wait for L in a store of fixed size: at most `onTheWay` of one kind are in it. What comes faster is left out,
/// but for the newest. In frames of the session; R only.
class ControlPace {
public:
    static constexpr int onTheWay = 48; // of two kinds, beside 32 others, in Session's room of 128

    /// The first frame from `from` on at which the next may go.
    std::int64_t nextFrom(std::int64_t from) const noexcept { return std::max(from, next_); }
    void wentAt(std::int64_t frame, std::int64_t playOutFrames) noexcept { next_ = frame + playOutFrames / onTheWay + 1; }

private:
    std::int64_t next_ = 0;
};

} // namespace physvib
