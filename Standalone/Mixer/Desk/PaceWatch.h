// SPDX-License-Identifier: GPL-3.0-or-later
// Checks whether the simulation keeps up with real time.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>

namespace physvib {

/// To be polled a few times a second; one thread at a time.
class PaceWatch {
public:
    static constexpr std::int64_t everyNs = 500'000'000;
    static constexpr double leastShare = 0.9; ///< below this share the world is too slow,
    static constexpr int leastBodies = 300;   ///< if it has this many bodies; a smaller world is delayed by
                                              ///< other load

    /// Share of real time at which the world ran since the last result, twice a second; nullopt in between.
    /// Arguments: session time, and the time by which the world is behind it (skipped after stalls, or not
    /// simulated yet). If session time decreases, a new session has begun.
    std::optional<double> look(std::int64_t sessionNs, std::int64_t behindNs) noexcept {
        if (sessionNs < sessionNs_) sessionNs_ = sessionNs, behindNs_ = behindNs;
        const std::int64_t passed = sessionNs - sessionNs_;
        if (passed < everyNs) return std::nullopt;
        const double share = 1.0 - static_cast<double>(behindNs - behindNs_) / static_cast<double>(passed);
        sessionNs_ = sessionNs;
        behindNs_ = behindNs;
        return std::clamp(share, 0.0, 1.0);
    }

private:
    std::int64_t sessionNs_ = 0, behindNs_ = 0;
};

} // namespace physvib
