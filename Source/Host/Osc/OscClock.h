// SPDX-License-Identifier: GPL-3.0-or-later
// Converts between OSC time tags (the sender's clock) and session time.
#pragma once
#include "Host/Osc/OscPacket.h"
#include "Live/Session/OutputClock.h"
#include <cstdint>

namespace physvib {

constexpr std::int64_t oscEpochSeconds = 2'208'988'800; ///< seconds from 1900 to 1970

/// Nanoseconds since 1970. Tags whose highest bit is 0 denote times from 2036 on. Any thread.
std::int64_t unixNsOf(OscTag tag) noexcept;
OscTag tagOf(std::int64_t unixNs) noexcept;

/// Estimates the system time at which the session started. Blocks show it only with jitter, so the estimate
/// is held constant: two tags one second apart are one second apart in the session, to the nanosecond. Once
/// the device's clock has drifted from the system's by `slackNs`, the estimate follows at `mostSlewPpm` at
/// most. One thread at a time.
class OscClock {
public:
    static constexpr std::int64_t slackNs = 1'000'000, jumpNs = 20'000'000, settleNs = 1'000'000'000;
    static constexpr std::int64_t mostSlewPpm = 200;

    /// `unixAheadNs`: system clock minus steady clock.
    void follow(const OutputMoment& moment, std::int64_t unixAheadNs) noexcept;

    bool isReady() const noexcept { return clock_.isReady(); }

    /// The session time of an event at `unixNs`; it is felt later by the output latency and the device's
    /// latency. Only if ready.
    std::int64_t sessionNs(std::int64_t unixNs) const noexcept { return unixNs - beganNs_; }
    /// The system time at which `sessionNs` is felt. Only if ready.
    std::int64_t feltUnixNs(std::int64_t sessionNs) const noexcept {
        return sessionNs + beganNs_ + behindNs_;
    }
    /// The system time at which `sessionNs` is the current session time. Only if ready.
    std::int64_t presentUnixNs(std::int64_t sessionNs) const noexcept { return sessionNs + beganNs_; }

private:
    SessionClock clock_;
    std::int64_t beganNs_ = 0, behindNs_ = 0; // start of the session, ns since 1970; latency until it is felt
    std::int64_t settledNs_ = 0, followedNs_ = 0; // of the steady clock
};

/// System clock minus steady clock, now. Any thread but R.
std::int64_t unixAheadNs() noexcept;

} // namespace physvib
