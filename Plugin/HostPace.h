// SPDX-License-Identifier: GPL-3.0-or-later
// Distinguishes hosts that request blocks ahead of time from hosts that catch up after a delay: only the
// former need a longer play-out latency.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// Render thread (R) only.
class HostPace {
public:
    static constexpr std::int64_t calmNs = 3'000'000'000;

    void reset() noexcept { *this = {}; }

    /// The host asks for so many frames more at that time, by a clock of ours.
    void ask(int frames, std::int64_t nowNs, int sampleRateHz) noexcept {
        if (asked_ == 0) startNs_ = nowNs;
        asked_ += frames;
        const double ahead =
            static_cast<double>(asked_) - 1e-9 * static_cast<double>(nowNs - startNs_) * sampleRateHz;
        goesAhead_ = ahead > most_ + 0.5 * frames;
        most_ = std::max(most_ - forgottenPerFrame * frames, ahead);
    }

    /// With what it asked last it is further ahead of the clock than before; else it was late, and catches
    /// up.
    bool goesAhead() const noexcept { return goesAhead_; }

    /// It catches up, and the world is not there. True from the third time in two seconds on: that is its
    /// way.
    bool stuttersAgain(std::int64_t nowNs) noexcept {
        if (stutters_ == 0 || nowNs - times_[0] > onceNs) {
            std::shift_right(times_.begin(), times_.end(), 1);
            times_[0] = nowNs;
            ++stutters_;
        }
        return stutters_ >= times_.size() && nowNs - times_.back() <= 2'000'000'000;
    }

private:
    static constexpr double forgottenPerFrame = 1e-3;  // clocks drift, and frames that a device lost never
                                                       // come
    static constexpr std::int64_t onceNs = 30'000'000; // blocks that come closer are of one stutter
    std::int64_t startNs_ = 0, asked_ = 0;
    double most_ = 0.0;
    bool goesAhead_ = false;
    std::array<std::int64_t, 3> times_{}; // the newest first
    std::size_t stutters_ = 0;
};

} // namespace physvib
