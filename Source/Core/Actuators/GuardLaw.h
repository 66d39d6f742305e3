// SPDX-License-Identifier: MIT
// The gain rule of OutputGuard and BoardGuard: how large a channel's gain may be in the next tile, given the
// samples already sent. No heap, and the same memory layout on every processor, so that a board can use it.
//
// Two quantities per channel, in seconds at full scale. Area: no stretch of the last 250 ms (up to 312 ms,
// because it is stored in five parts) may hold more than 12.5 ms of one sign. So no mean over 250 ms exceeds
// limits::guardShare, even if the channel is muted in between. Load: the squared output of a low-pass at
// limits::slowestToneHz, with a forgetting time of a second, plus half of what the filter's state would still
// put out. The low-pass is damped so that nothing below that frequency is weakened, and a burst with what is
// permitted after it stays within a second's bound: half of the load's bound would be the share's square.
// Both grow by what a tile adds, so the gain follows the remaining margin and closes before a bound is
// reached. A signal that closes it repeatedly lowers the resting gain, until the tone passes undistorted
// at that gain. Below half of both bounds the gain rises, within limits::guardReleaseSeconds.
#pragma once
#include "Core/Limits.h"
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace physvib {

namespace limits {
constexpr double guardShare = 0.05; // of full scale: a quarter of a percent of its power, whatever else plays
constexpr double guardSeconds = 0.25; // a mean over a shorter time is a perceptible vibration
constexpr float guardLoad = 0.00125f; // of full scale squared, below slowestToneHz: half of guardShare's
                                      // square, as much again may come within the second in which it is
                                      // forgotten
constexpr float guardDamping = 1.0f;  // of the low-pass: 1 at direct current and slowestToneHz, more between
constexpr float guardOfSlow = 0.5f / guardDamping + 0.5f * guardDamping, // the energy that is still in it
    guardOfSpeed = 0.5f / guardDamping;
constexpr float guardPerLoad = 7000.0f;     // the gain closes over the last ninth of the load
constexpr float guardReleaseSeconds = 1.0f; // from silence to full gain: slower than what it reduces
constexpr float guardRestSeconds = 0.2f;    // time constant of the resting gain: longer than a burst shuts it
} // namespace limits

/// Position of a guard in the signal path. `rendered` has lower bounds than `last`, so `last` seldom acts.
enum class GuardPlace { rendered, last };

/// The guard's state of one channel: how far its area was above and below the present one, the state of the
/// low-pass, the load and the resting gain.
struct GuardSums {
    float high = 0.0f, low = 0.0f, slow = 0.0f, speed = 0.0f, load = 0.0f, rest = 1.0f;
};

/// The rule for at most `MaxChannels` channels. Render thread (R) only; prepare: message thread (M).
template <int MaxChannels>
class GuardLaw {
public:
    using Row = std::array<float, static_cast<std::size_t>(MaxChannels)>; ///< of each channel

    /// Resets the sums. M, not while rendering.
    void prepare(int channels, GuardPlace place) noexcept {
        channels_ = static_cast<std::uint32_t>(channels);
        place_ = place;
        episodes_ = 0;
        clear();
    }

    /// Duration of a tile from now on, at most about 1 ms; the sums stay. M, not while rendering.
    void setTile(float seconds) noexcept {
        partTile_ = 0;               // the current part takes longer, never shorter
        constexpr float zone = 3.0f; // tiles; with fewer, a ramp of one tile would overshoot
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

    GuardSums sums(std::size_t j) const noexcept {
        return {std::max(high_[j], oldHigh_[j]) - sum_[j],
                std::min(low_[j], oldLow_[j]) - sum_[j],
                slow_[j],
                speed_[j],
                load_[j],
                rest_[j]};
    }
    /// Restores the sums of a channel, as if their extremes had just happened. Call it after prepare().
    void restore(std::size_t j, const GuardSums& saved) noexcept {
        const std::size_t newest = (part_ + parts - 1) % parts;
        oldHigh_[j] = highs_[newest][j] = saved.high;
        oldLow_[j] = lows_[newest][j] = saved.low;
        sum_[j] = high_[j] = low_[j] = 0.0f;
        slow_[j] = saved.slow, speed_[j] = saved.speed, load_[j] = saved.load;
        rest_[j] = ends_[j] = saved.rest;
        silentSeconds_ = 0.0f;
    }
    /// Adds a channel, at rest. R.
    void addChannel() noexcept { ++channels_; }

    /// `areas` of the tile just sent, in seconds at full scale. False: the next tile is played unchanged.
    bool update(const Row& areas) noexcept {
        std::size_t silent = 0;
        while (silent < channels_ && areas[silent] == 0.0f) ++silent;
        const bool isSilent = silent == channels_;
        if (isSilent && isAtRest()) return false; // tones too weak for a unit: there is nothing to clear
        silentSeconds_ = isSilent ? silentSeconds_ + tile_ : 0.0f;
        if (isAtRest()) {
            clear();
            return false;
        }
        const float lowest = updateGains(areas);
        if (++partTile_ >= partTiles_) endPart();
        episodes_ += lowest < 1.0f && gain_ == 1.0f ? 1 : 0;
        const bool isActing = lowest < 1.0f || gain_ < 1.0f;
        gain_ = lowest;
        return isActing;
    }

    /// Gain at the start of the next tile; it changes linearly to endGain() at its end.
    float startGain(std::size_t channel) const noexcept { return starts_[channel]; }
    float endGain(std::size_t channel) const noexcept { return ends_[channel]; }

    bool isAtRest() const noexcept {
        return silentSeconds_ >= forgetSeconds;
    }                                             ///< no sum is left: silent for long
    float gain() const noexcept { return gain_; } ///< lowest of all channels; 1: no reduction
    /// How often it began to act, since prepare.
    std::uint32_t episodes() const noexcept { return episodes_; }

private:
    static constexpr int parts = 4; // complete ones, beside the current one
    static constexpr float forgetSeconds = 8.0f;
    // std::max and std::min by value: a loop with these becomes one of vectors
    static constexpr float greater(float a, float b) noexcept { return a < b ? b : a; }
    static constexpr float lesser(float a, float b) noexcept { return b < a ? b : a; }

    // Not inlined, like endPart: a board keeps only per-tile code in its small fast memory.
    [[gnu::noinline]] void clear() noexcept {
        for (Row* row : {&sum_, &high_, &low_, &oldHigh_, &oldLow_, &slow_, &speed_, &load_}) row->fill(0.0f);
        for (auto& row : highs_) row.fill(0.0f);
        for (auto& row : lows_) row.fill(0.0f);
        starts_.fill(1.0f);
        ends_.fill(1.0f);
        rest_.fill(1.0f);
        gain_ = 1.0f;
        silentSeconds_ = forgetSeconds;
        partTile_ = 0;
        part_ = 0;
    }

    // A second-order low-pass in steps of a tile. The quadratic form, by w, is the energy that its output
    // would still have without further input. Returns the lowest of the new gains.
    float updateGains(const Row& areas) noexcept {
        constexpr auto w = static_cast<float>(6.283185307 * limits::slowestToneHz);
        const float step = w * tile_;
        auto lowest = std::bit_cast<std::int32_t>(1.0f); // gains from +0 on are in order as their bits are
        for (std::size_t j = 0; j < channels_; ++j) {
            const float sum = sum_[j] + areas[j];
            sum_[j] = sum;
            high_[j] = greater(high_[j], sum);
            low_[j] = lesser(low_[j], sum);
            const float area =
                greater(greater(high_[j], oldHigh_[j]) - sum, sum - lesser(low_[j], oldLow_[j]));
            speed_[j] += w * areas[j] - step * (slow_[j] + limits::guardDamping * speed_[j]);
            slow_[j] += step * speed_[j];
            const float z = slow_[j], v = speed_[j];
            load_[j] += tile_ * (z * z - load_[j]);
            const float load =
                load_[j] + (limits::guardOfSlow * z * z + z * v + limits::guardOfSpeed * v * v) * (0.5f / w);
            const float room = lesser((maxArea_ - area) * perArea_, (maxLoad_ - load) * limits::guardPerLoad);
            starts_[j] = ends_[j];
            const float newGain = greater(0.0f, lesser(room, rest_[j]));
            ends_[j] = newGain;
            lowest = std::min(lowest, std::bit_cast<std::int32_t>(newGain));
            // Above half of a bound it only falls: a reduced tone gets one gain and keeps its waveform.
            const float up = lesser(1.0f, rest_[j] + rise_), down = rest_[j] - fall_ * (rest_[j] - ends_[j]);
            const float half = area < 0.5f * maxArea_ ? up : down;
            rest_[j] = load < 0.5f * maxLoad_ ? half : down;
        }
        return std::bit_cast<float>(lowest);
    }

    // Sums restart at 0, so that they stay exact.
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

    std::uint32_t channels_ = 0, part_ = 0; // of 32 bits, so that boards and computers have one layout
    GuardPlace place_ = GuardPlace::last;
    float tile_ = 0.0f, maxArea_ = 0.0f, perArea_ = 0.0f, maxLoad_ = 0.0f, rise_ = 0.0f, fall_ = 0.0f,
          silentSeconds_ = 0.0f, gain_ = 1.0f;
    int partTiles_ = 1, partTile_ = 0;
    std::uint32_t episodes_ = 0;
    Row sum_{}, high_{}, low_{}, oldHigh_{}, oldLow_{}; // of the part; its extremes; those of earlier ones
    std::array<Row, parts> highs_{}, lows_{};
    Row slow_{}, speed_{}, load_{}, starts_{}, ends_{}, rest_{};
};

} // namespace physvib
