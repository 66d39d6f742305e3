// SPDX-License-Identifier: GPL-3.0-or-later
// Time tags and session time: what a sender's clock says, and when that is in the session.
#pragma once
#include "Host/Osc/OscPacket.h"
#include "Live/Session/FeltClock.h"
#include <cstdint>

namespace physvib {

constexpr std::int64_t oscEpochSeconds = 2'208'988'800; ///< from 1900 to 1970

/// Nanoseconds since 1970. Tags whose highest bit is 0 are those from 2036 on. Any thread.
std::int64_t unixNsOf(OscTag tag) noexcept;
OscTag tagOf(std::int64_t unixNs) noexcept;

/// The session began at a moment of the system's clock. Blocks tell of it only to within their jitter, so
/// that moment is held: two tags a second apart are a second apart in the session, to the nanosecond, until
/// the device's clock has drifted away from the system's by `slackNs`; then it is followed by `mostSlewPpm`
/// at most. One thread at a time.
class OscClock {
public:
    static constexpr std::int64_t slackNs = 1'000'000, jumpNs = 20'000'000, settleNs = 1'000'000'000;
    static constexpr std::int64_t mostSlewPpm = 200;

    /// `unixAheadNs`: by which the system's clock is ahead of the steady one.
    void follow(const FeltMoment& moment, std::int64_t unixAheadNs) noexcept;

    bool isReady() const noexcept { return clock_.isReady(); }

    /// The session time of what is said to happen at `unixNs`: it is felt the play-out delay and the device's
    /// own later. Only if ready.
    std::int64_t sessionNs(std::int64_t unixNs) const noexcept { return unixNs - beganNs_; }
    /// When `sessionNs` is felt, on the system's clock. Only if ready.
    std::int64_t feltUnixNs(std::int64_t sessionNs) const noexcept {
        return sessionNs + beganNs_ + behindNs_;
    }
    /// When `sessionNs` is the present there. Only if ready.
    std::int64_t presentUnixNs(std::int64_t sessionNs) const noexcept { return sessionNs + beganNs_; }

private:
    FeltClock clock_;
    std::int64_t beganNs_ = 0, behindNs_ = 0;     // session time 0, since 1970
    std::int64_t settledNs_ = 0, followedNs_ = 0; // of the steady clock
};

/// By which the system's clock is ahead of the steady one now. Any thread but R.
std::int64_t unixAheadNs() noexcept;

} // namespace physvib
