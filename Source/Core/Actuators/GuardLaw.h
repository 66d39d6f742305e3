// SPDX-License-Identifier: MIT
// How loud a channel may be in the next tile, given what has left it: the law of OutputGuard. No heap, and
// one layout on every processor, so that a board can use it.
//
// Two sums per channel, in seconds at full scale. Area: no stretch of the last 250 ms (up to 312 ms: it is
// kept in five parts) may hold more than 12.5 ms of one sign, so no mean over 250 ms exceeds
// limits::guardShare, nor does one if the channel is muted in between. Load: what a low-pass of
// limits::slowestToneHz lets through, squared, forgotten within a second, and half of what the filter would
// still give of what it holds. Both grow by what a tile adds, so the gain is the room that is left: it closes
// before a bound is reached. What closes it again and again lowers the gain at which it rests, until a tone
// passes whole at that gain. Below half of both bounds it rises, within limits::guardReleaseSeconds.
#pragma once
#include "Core/Limits.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib {

namespace limits {
constexpr double guardShare = 0.05; // of full scale: a quarter of a percent of its power, whatever else plays
constexpr double guardSeconds = 0.25; // a mean over less is a vibration that is felt
constexpr float guardLoad = 0.00125f; // of full scale squared, below slowestToneHz: half of it passes at that
                                      // very frequency
constexpr float guardPerLoad = 7000.0f;     // the gain closes over the last ninth of it
constexpr float guardReleaseSeconds = 1.0f; // silence to full gain: slower than what it turns down
constexpr float guardRestSeconds = 0.1f;    // how fast the gain comes to rest: a few periods of such a tone
} // namespace limits

/// Where a guard stands. `rendered` has lower bounds than `last`, which therefore seldom has anything left to
/// do.
enum class GuardPlace { rendered, last };

/// R only, but for prepare: M.
template <int Most>
class GuardLaw {
public:
    using Row = std::array<float, static_cast<std::size_t>(Most)>; ///< of each channel

    /// Nothing has left. M, not while rendering.
    void prepare(int channels, GuardPlace place) noexcept {
        channels_ = static_cast<std::uint32_t>(channels);
        place_ = place;
        episodes_ = 0;
        clear();
    }

    /// How long a tile lasts from now on, at most about 1 ms; what has left stays known. M, not while
    /// rendering.
    void setTile(float seconds) noexcept {
        constexpr float zone = 3.0f; // tiles; fewer, and a ramp of one tile would overshoot
        const bool isLast = place_ == GuardPlace::last;
        tile_ = seconds;
        maxArea_ = static_cast<float>(limits::guardShare * limits::guardSeconds) -
                   (isLast ? 1.0f : 1.25f + zone) * seconds;
        perArea_ = 1.0f / (zone * seconds);
        rise_ = seconds / limits::guardReleaseSeconds;
        fall_ = seconds / limits::guardRestSeconds;
        maxLoad_ = (isLast ? 1.0f : 0.88f) * limits::guardLoad;
        partTiles_ = static_cast<int>(limits::guardSeconds / (parts * seconds)) + 1;
    }

    /// `areas` of the tile that has just left, seconds at full scale. False: the next one is played as it is.
    bool take(const Row& areas) noexcept {
        std::size_t silent = 0;
        while (silent < channels_ && areas[silent] == 0.0f) ++silent;
        const bool isSilent = silent == channels_;
        silentSeconds_ = isSilent ? silentSeconds_ + tile_ : 0.0f;
        if (silentSeconds_ >= forgetSeconds) clear();
        if (isAtRest()) return false;
        const float least = follow(areas);
        if (++partTile_ >= partTiles_) endPart();
        episodes_ += least < 1.0f && gain_ == 1.0f ? 1 : 0;
        const bool acts = least < 1.0f || gain_ < 1.0f;
        gain_ = least;
        return acts;
    }

    /// Of the next tile: its gain goes in a straight line from one to the other.
    float from(std::size_t channel) const noexcept { return from_[channel]; }
    float to(std::size_t channel) const noexcept { return to_[channel]; }

    bool isAtRest() const noexcept {
        return silentSeconds_ >= forgetSeconds;
    }                                             ///< nothing is known of what left
    float gain() const noexcept { return gain_; } ///< the least of all channels; 1: it does nothing
    std::uint32_t episodes() const noexcept {
        return episodes_;
    } ///< how often it began to act, since prepare

private:
    static constexpr int parts = 4; // whole ones, and the one that goes on
    static constexpr float forgetSeconds = 8.0f, root2 = 1.41421356f;

    // Apart, as is endPart: a board keeps what runs for every tile in a small memory of its own.
    [[gnu::noinline]] void clear() noexcept {
        for (Row* row : {&sum_, &high_, &low_, &oldHigh_, &oldLow_, &slow_, &speed_, &load_}) row->fill(0.0f);
        for (auto& row : highs_) row.fill(0.0f);
        for (auto& row : lows_) row.fill(0.0f);
        from_.fill(1.0f);
        to_.fill(1.0f);
        rest_.fill(1.0f);
        gain_ = 1.0f;
        silentSeconds_ = forgetSeconds;
        partTile_ = 0;
        part_ = 0;
    }

    // A Butterworth low-pass of the second order in steps of a tile; the quadratic form is what the square of
    // its output adds up to if nothing more comes in. Returns the least of the new gains.
    float follow(const Row& areas) noexcept {
        constexpr auto w = static_cast<float>(6.283185307 * limits::slowestToneHz);
        const float step = w * tile_;
        float least = 1.0f;
        for (std::size_t j = 0; j < channels_; ++j) {
            const float sum = sum_[j] + areas[j];
            sum_[j] = sum;
            high_[j] = std::max(high_[j], sum);
            low_[j] = std::min(low_[j], sum);
            const float most =
                std::max(std::max(high_[j], oldHigh_[j]) - sum, sum - std::min(low_[j], oldLow_[j]));
            speed_[j] += w * areas[j] - step * (slow_[j] + root2 * speed_[j]);
            slow_[j] += step * speed_[j];
            const float z = slow_[j], v = speed_[j];
            load_[j] += tile_ * (z * z - load_[j]);
            const float load = load_[j] + (1.0606602f * z * z + z * v + 0.3535534f * v * v) * (0.5f / w);
            const float room =
                std::min((maxArea_ - most) * perArea_, (maxLoad_ - load) * limits::guardPerLoad);
            from_[j] = to_[j];
            to_[j] = std::max(0.0f, std::min(room, rest_[j]));
            least = std::min(least, to_[j]);
            // Above half of a bound it only falls: a tone that is turned down finds one gain, and keeps its
            // shape.
            const bool mayRise = most < 0.5f * maxArea_ && load < 0.5f * maxLoad_;
            rest_[j] = mayRise ? std::min(1.0f, rest_[j] + rise_) : rest_[j] - fall_ * (rest_[j] - to_[j]);
        }
        return least;
    }

    // Sums begin at 0 again, so that they stay as exact as they are.
    [[gnu::noinline]] void endPart() noexcept {
        highs_[part_] = high_;
        lows_[part_] = low_;
        part_ = (part_ + 1) % parts;
        partTile_ = 0;
        for (std::size_t j = 0; j < channels_; ++j) {
            float high = 0.0f, low = 0.0f;
            for (auto& row : highs_) high = std::max(high, row[j] -= sum_[j]);
            for (auto& row : lows_) low = std::min(low, row[j] -= sum_[j]);
            oldHigh_[j] = high;
            oldLow_[j] = low;
            sum_[j] = high_[j] = low_[j] = 0.0f;
        }
    }

    std::uint32_t channels_ = 0, part_ = 0; // of 32 bits, so that a board and a computer have one layout
    GuardPlace place_ = GuardPlace::last;
    float tile_ = 0.0f, maxArea_ = 0.0f, perArea_ = 0.0f, maxLoad_ = 0.0f, rise_ = 0.0f, fall_ = 0.0f,
          silentSeconds_ = 0.0f, gain_ = 1.0f;
    int partTiles_ = 1, partTile_ = 0;
    std::uint32_t episodes_ = 0;
    Row sum_{}, high_{}, low_{}, oldHigh_{}, oldLow_{}; // since the part began; of it; of those before
    std::array<Row, parts> highs_{}, lows_{};
    Row slow_{}, speed_{}, load_{}, from_{}, to_{}, rest_{};
};

} // namespace physvib
