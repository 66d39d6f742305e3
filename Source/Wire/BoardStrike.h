// SPDX-License-Identifier: MIT
// From collisions to what the board plays, and the policy when the line cannot carry all of them: the weakest go first.
#pragma once
#include "Core/BoardEvent.h"
#include "Core/CollisionEvent.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace physvib {

/// A collision on its way to the board; its frame is not yet known.
struct BoardStrike {
    std::int64_t onsetNs = 0; ///< on the computer's steady clock
    BoardEvent event;

    int peak() const noexcept {
        int most = 0;
        for (const int a : event.amplitudes) most = std::max(most, std::abs(a));
        return most;
    }
};

/// Rounded to the numbers of the link; amplitudes beyond 8 times full scale stay there. `gains`: one per board channel,
/// of the panner. A frequency that the board cannot play gives an event that isPlayable refuses. Any thread.
inline BoardEvent boardEventOf(const CollisionEvent& e, const std::array<double, limits::board::channels>& gains) noexcept {
    const auto rounded = [](double value, double low, double high) { return std::clamp(std::nearbyint(value), low, high); };
    BoardEvent b;
    b.frequency16 = static_cast<std::uint16_t>(rounded(e.frequencyHz * limits::board::gridPerHz, 0.0, 65535.0));
    b.decay16 = static_cast<std::uint16_t>(rounded(e.decayPerSecond * limits::board::gridPerHz, e.decayPerSecond > 0.0 ? 1.0 : 0.0, 65535.0));
    if (e.durationNs > 0) b.durationMs = static_cast<std::uint16_t>(rounded(static_cast<double>(e.durationNs) * 1e-6, 1.0, 65535.0));
    for (std::size_t j = 0; j < gains.size(); ++j)
        b.amplitudes[j] = static_cast<std::int16_t>(rounded(e.amplitude * gains[j] * limits::board::amplitudeUnit, -32768.0, 32767.0));
    return b;
}

/// Strikes that wait for the line, by onset. When it is full, the weakest of all goes, and is counted. One thread.
class StrikeBacklog {
public:
    static constexpr int capacity = 32; // 44 ms of the line in the compact form: more would come too late

    bool empty() const noexcept { return size_ == 0; }
    int size() const noexcept { return size_; }
    std::uint64_t thinned() const noexcept { return thinned_; }
    const BoardStrike& first() const noexcept { return strikes_.front(); }

    void push(const BoardStrike& strike) noexcept {
        const auto end = strikes_.begin() + size_;
        if (size_ == capacity) {
            ++thinned_;
            const auto weakest = std::min_element(strikes_.begin(), end, [](const auto& a, const auto& b) { return a.peak() < b.peak(); });
            if (strike.peak() <= weakest->peak()) return;
            std::copy(weakest + 1, end, weakest);
            --size_;
        }
        const auto filled = strikes_.begin() + size_;
        const auto after = std::upper_bound(strikes_.begin(), filled, strike, [](const auto& a, const auto& b) { return a.onsetNs < b.onsetNs; });
        std::copy_backward(after, filled, filled + 1);
        *after = strike;
        ++size_;
    }

    void pop() noexcept {
        std::copy(strikes_.begin() + 1, strikes_.begin() + size_, strikes_.begin());
        --size_;
    }

    void clear() noexcept { size_ = 0; }

private:
    std::array<BoardStrike, static_cast<std::size_t>(capacity) + 1> strikes_{};
    int size_ = 0;
    std::uint64_t thinned_ = 0;
};

} // namespace physvib
