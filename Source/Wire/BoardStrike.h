// SPDX-License-Identifier: MIT
// Conversion of collision events to board events, and the queue that drops the weakest events when the line
// is overloaded.
#pragma once
#include "Core/BoardEvent.h"
#include "Core/CollisionEvent.h"
#include "Core/Modes/ModeIncrements.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace physvib {

/// An event on its way to the board; its frame is not known yet.
struct BoardStrike {
    std::int64_t onsetNs = 0; ///< on the computer's steady clock
    BoardEvent event;

    int peak() const noexcept {
        int maxMagnitude = 0;
        for (const int a : event.amplitudes) maxMagnitude = std::max(maxMagnitude, std::abs(a));
        return maxMagnitude;
    }
};

/// Decay in the link's units. A non-zero decay stays non-zero. Any thread, as all functions here.
inline std::uint16_t boardDecay16(double decayPerSecond) noexcept {
    return static_cast<std::uint16_t>(std::clamp(std::nearbyint(decayPerSecond * limits::board::gridPerHz),
                                                 decayPerSecond > 0.0 ? 1.0 : 0.0, 65535.0));
}
inline std::int16_t boardAmplitude(double amplitude) noexcept {
    return static_cast<std::int16_t>(
        std::clamp(std::nearbyint(amplitude * limits::board::amplitudeUnit), -32768.0, 32767.0));
}

/// Amplitude of a tone after `seconds`, for events that continue one.
inline double amplitudeAfter(const CollisionEvent& event, double seconds) noexcept {
    return seconds > 0.0 ? event.amplitude * shareLeft(event.decayPerSecond, seconds) : event.amplitude;
}

/// How long an event lasts, ns: to its end, or until it has decayed by limits::retireDecibels.
inline std::int64_t boardLifetimeNs(const CollisionEvent& event) noexcept {
    const auto end = static_cast<double>(event.durationNs > 0 ? event.durationNs : limits::maxTimeNs);
    constexpr double nepers = limits::retireDecibels / (20.0 * std::numbers::log10e);
    return static_cast<std::int64_t>(
        event.decayPerSecond > 0.0 ? std::min(end, nepers / event.decayPerSecond * 1e9) : end);
}

/// The longest duration that a strike can have on the link.
constexpr std::int64_t longestStrikeNs = 65'535'000'000;

/// True if one strike would end before the event does.
inline bool outlastsStrike(const CollisionEvent& event) noexcept {
    return event.durationNs > longestStrikeNs && boardLifetimeNs(event) > longestStrikeNs;
}

/// Rounded to the link's units; amplitudes are clamped to 8 times full scale. `gains`: the panner's, one per
/// board channel. If the board cannot play the frequency, isPlayable refuses the result. An event that
/// continues a tone has the tone's amplitude by then, but starts at phase 0. One that outlastsStrike is cut.
/// Any thread.
inline BoardEvent toBoardEvent(const CollisionEvent& event,
                               const std::array<double, limits::board::channels>& gains) noexcept {
    const auto rounded = [](double value, double low, double high) {
        return std::clamp(std::nearbyint(value), low, high);
    };
    BoardEvent board;
    board.frequency16 =
        static_cast<std::uint16_t>(rounded(event.frequencyHz * limits::board::gridPerHz, 0.0, 65535.0));
    board.decay16 = boardDecay16(event.decayPerSecond);
    if (event.durationNs > 0)
        board.durationMs =
            static_cast<std::uint16_t>(rounded(static_cast<double>(event.durationNs) * 1e-6, 1.0, 65535.0));
    const double amplitude = amplitudeAfter(event, static_cast<double>(event.course.toneAgeNs) * 1e-9);
    for (std::size_t j = 0; j < gains.size(); ++j) board.amplitudes[j] = boardAmplitude(amplitude * gains[j]);
    return board;
}

/// Timing of the line at present.
struct LineTiming {
    std::int64_t freeNs = 0;    ///< time at which everything written has been transmitted
    std::int64_t strikeNs = 0;  ///< transmission time of an event
    std::int64_t transitNs = 0; ///< from transmission until the board can play it
};

/// Events that are pending for the line, by onset. When full, the weakest is dropped and counted. One thread.
class StrikeBacklog {
public:
    static constexpr int capacity = 32; // 44 ms of the line in the compact form: more would be late

    bool empty() const noexcept { return size_ == 0; }
    int size() const noexcept { return size_; }
    std::uint64_t thinned() const noexcept { return thinned_; }
    const BoardStrike& first() const noexcept { return strikes_.front(); }

    void push(const BoardStrike& strike) noexcept {
        const auto end = strikes_.begin() + size_;
        if (size_ == capacity) {
            const auto weakest = weakestBefore(end);
            if (strike.peak() <= weakest->peak()) return void(++thinned_);
            thin(weakest);
        }
        const auto oldEnd = strikes_.begin() + size_;
        const auto position =
            std::upper_bound(strikes_.begin(), oldEnd, strike,
                             [](const auto& a, const auto& b) { return a.onsetNs < b.onsetNs; });
        std::copy_backward(position, oldEnd, oldEnd + 1);
        *position = strike;
        ++size_;
    }

    void pop() noexcept {
        std::copy(strikes_.begin() + 1, strikes_.begin() + size_, strikes_.begin());
        --size_;
    }

    /// If an event would be late because of those before it, drops the weakest of all of these and counts it.
    /// An event that would be late even as the first one stays, because dropping others would not help.
    void dropLate(const LineTiming& line) noexcept {
        for (int i = 1; i < size_;) {
            if (isInTime(line, i, i + 1) || !isInTime(line, i, 1)) {
                ++i;
                continue;
            }
            thin(weakestBefore(strikes_.begin() + i + 1));
            i = std::max(1, i - 1);
        }
    }

    void clear() noexcept { size_ = 0; }

private:
    using Strikes = std::array<BoardStrike, static_cast<std::size_t>(capacity) + 1>;

    Strikes::iterator weakestBefore(Strikes::iterator end) noexcept {
        return std::min_element(strikes_.begin(), end,
                                [](const auto& a, const auto& b) { return a.peak() < b.peak(); });
    }
    void thin(Strikes::iterator strike) noexcept {
        std::copy(strike + 1, strikes_.begin() + size_, strike);
        --size_;
        ++thinned_;
    }
    /// True if event `strike` is in time after `onTheLine` transmissions, its own included.
    bool isInTime(const LineTiming& line, int strike, int onTheLine) const noexcept {
        return line.freeNs + onTheLine * line.strikeNs + line.transitNs <=
               strikes_[static_cast<std::size_t>(strike)].onsetNs;
    }

    Strikes strikes_{};
    int size_ = 0;
    std::uint64_t thinned_ = 0;
};

} // namespace physvib
