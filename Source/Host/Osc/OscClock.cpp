// SPDX-License-Identifier: GPL-3.0-or-later
// Converts OSC time tags, and estimates the system time at which the session started.
#include "Host/Osc/OscClock.h"
#include <algorithm>
#include <chrono>
#include <cstdlib>

namespace physvib {
namespace {

constexpr std::int64_t second = 1'000'000'000, era = std::int64_t{1} << 32;

template <class Clock>
std::int64_t nowOf() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

} // namespace

std::int64_t unixNsOf(OscTag tag) noexcept {
    auto seconds = static_cast<std::int64_t>(tag >> 32);
    if (seconds < era / 2) seconds += era;
    const auto fraction = static_cast<std::int64_t>(
        ((tag & 0xffff'ffffu) * static_cast<std::uint64_t>(second) + (std::uint64_t{1} << 31)) >> 32);
    return (seconds - oscEpochSeconds) * second + fraction;
}

OscTag tagOf(std::int64_t unixNs) noexcept {
    const std::int64_t since = std::max<std::int64_t>(0, unixNs);
    const auto fraction =
        ((static_cast<std::uint64_t>(since % second) << 32) + static_cast<std::uint64_t>(second) / 2) /
        static_cast<std::uint64_t>(second);
    return (static_cast<OscTag>(since / second + oscEpochSeconds) << 32) + fraction;
}

std::int64_t unixAheadNs() noexcept {
    std::int64_t best = INT64_MAX, ahead = 0;
    for (int k = 0; k < 3; ++k) { // the thread may be interrupted between two clock reads
        const std::int64_t before = nowOf<std::chrono::steady_clock>(),
                           unix = nowOf<std::chrono::system_clock>(),
                           after = nowOf<std::chrono::steady_clock>();
        if (after - before >= best) continue;
        best = after - before;
        ahead = unix - before - best / 2;
    }
    return ahead;
}

void OscClock::follow(const OutputMoment& moment, std::int64_t unixAheadNs) noexcept {
    if (moment.steadyNs == 0) return;
    clock_.add({moment.sessionNs + moment.behindNs, moment.steadyNs});
    behindNs_ = moment.behindNs;
    const std::int64_t seen = clock_.steadyAt(0) + unixAheadNs, away = seen - beganNs_;
    if (std::abs(away) > jumpNs) { // first estimate, another device, or the system clock was set
        beganNs_ = seen;
        settledNs_ = moment.steadyNs + settleNs;
    } else if (moment.steadyNs < settledNs_) {
        beganNs_ = std::min(beganNs_, seen);
    } else if (std::abs(away) > slackNs) {
        const std::int64_t most = (moment.steadyNs - followedNs_) * mostSlewPpm / 1'000'000;
        beganNs_ += std::clamp(away, -most, most);
    }
    followedNs_ = moment.steadyNs;
}

} // namespace physvib
