// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a world keeps up with real time.
#pragma once
#include <cstdint>
#include <optional>

namespace physvib {

/// Asked a few times a second; one thread at a time.
class PaceWatch {
public:
    static constexpr std::int64_t everyNs = 500'000'000;
    static constexpr double leastShare = 0.9; ///< below it a world is too much,
    static constexpr int leastBodies = 300;   ///< if it is that large: a smaller one is kept waiting by the machine

    /// The share of real time that the world has run at since the last answer, twice a second; none between. Both of the session: its time,
    /// and what of it was given up after stalls. What goes back is another session.
    std::optional<double> look(std::int64_t sessionNs, std::int64_t slippedNs) noexcept {
        if (sessionNs < sessionNs_ || slippedNs < slippedNs_) sessionNs_ = sessionNs, slippedNs_ = slippedNs;
        const std::int64_t passed = sessionNs - sessionNs_;
        if (passed < everyNs) return std::nullopt;
        const double share = 1.0 - static_cast<double>(slippedNs - slippedNs_) / static_cast<double>(passed);
        sessionNs_ = sessionNs;
        slippedNs_ = slippedNs;
        return share < 0.0 ? 0.0 : share;
    }

private:
    std::int64_t sessionNs_ = 0, slippedNs_ = 0;
};

} // namespace physvib
