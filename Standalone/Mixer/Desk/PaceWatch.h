// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a world keeps up with real time.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>

namespace physvib {

/// Asked a few times a second; one thread at a time.
class PaceWatch {
public:
    static constexpr std::int64_t everyNs = 500'000'000;
    static constexpr double leastShare = 0.9; ///< below it a world is too much,
    static constexpr int leastBodies = 300;   ///< if it is that large: a smaller one is kept waiting by the
                                              ///< machine

    /// The share of real time that the world has run at since the last answer, twice a second; none between.
    /// Both of the session: its time, and how far the world is behind it: what was given up after stalls, and
    /// what it has not been stepped to yet. Time that goes back is another session's.
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
