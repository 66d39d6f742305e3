// SPDX-License-Identifier: MIT
// Numbers and types of the Pico's signal path, and the guard, the last stage before the actuators: GuardLaw
// with the bounds of GuardPlace::last in integers, as the chip has no floating point. It keeps each channel's
// mean over 250 ms, and its content below 5 Hz, within limits::guardShare of full scale (GuardLaw.h).
// Units: areas are sums of samples; slow and speed (the low-pass) are multiples of 2^-24 of full scale,
// resting gains of 2^-30, loads of 2^-28 of its square. All products fit 32 bits, as those of the chip.
#pragma once
#include "Core/Actuators/GuardLaw.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib::pico {

constexpr int sampleRateHz = 48000;
constexpr int tileFrames = 16; // a third of a millisecond: gains and the guard are decided once per tile
constexpr int tilesPerSecond = sampleRateHz / tileFrames;
constexpr std::int32_t unity = 32768; // gains are multiples of 2^-15; this one leaves every sample unchanged

/// A sample of each channel, as they come in USB packets. Aligned, so that the chip copies words.
template <int channels>
struct alignas(4) Frame : std::array<std::int16_t, static_cast<std::size_t>(channels)> {};
template <int channels>
using Tile = std::array<Frame<channels>, static_cast<std::size_t>(tileFrames)>;

/// Product of two gains from 0 to unity. Any thread.
constexpr std::int32_t product(std::int32_t a, std::int32_t b) noexcept {
    return a * b / unity; // 2^30 at most
}

/// The guard of all channels. Interrupt of the output only.
template <int channels>
class FixedGuard {
public:
    using Sums = std::array<std::int32_t, static_cast<std::size_t>(channels)>; ///< of a tile's samples

    /// `sums`: of the tile that was sent last. Computes the gains for the end of the next tile.
    void update(const Sums& sums) noexcept {
        bool isSilent = true;
        for (const auto sum : sums) isSilent = isSilent && sum == 0;
        silentTiles_ = isSilent ? std::min(silentTiles_ + 1, forgetTiles) : 0;
        if (silentTiles_ == forgetTiles) {
            if (!isAtRest_) reset();
            return;
        }
        isAtRest_ = false;
        std::int32_t minGain = unity;
        for (std::size_t j = 0; j < sums.size(); ++j)
            minGain = std::min(minGain, updateChannel(channel_[j], sums[j]));
        if (++tileInPart_ == tilesPerPart) endPart();
        episodes_ += minGain < unity && gain_ == unity ? 1 : 0;
        gain_ = minGain;
    }

    std::int32_t gainAtEnd(std::size_t channel) const noexcept {
        return channel_[channel].endGain;
    }                                                             ///< 0 to unity
    std::int32_t gain() const noexcept { return gain_; }          ///< lowest of all channels
    std::uint32_t episodes() const noexcept { return episodes_; } ///< how often it began to reduce the gain

private:
    static constexpr int partCount = 4;
    static constexpr std::int32_t tilesPerPart =
        static_cast<std::int32_t>(limits::guardSeconds * tilesPerSecond) / partCount + 1;
    static constexpr std::int32_t forgetTiles = 8 * tilesPerSecond;
    static constexpr std::int32_t maxArea =
        static_cast<std::int32_t>(limits::guardShare * limits::guardSeconds * sampleRateHz - tileFrames) *
        unity;
    static constexpr std::int32_t zoneFrames = 3 * tileFrames; // the gain closes over the last three tiles
    static constexpr std::int32_t loadUnit = 1 << 28;
    static constexpr auto maxLoad = static_cast<std::int32_t>(limits::guardLoad * loadUnit);
    static constexpr auto perLoad = static_cast<std::int32_t>(limits::guardPerLoad);
    static constexpr std::int32_t fullRestingGain = 1 << 30, restingRise = fullRestingGain / tilesPerSecond;
    static constexpr std::int32_t restingFallTiles =
        static_cast<std::int32_t>(limits::guardRestSeconds * tilesPerSecond);
    static constexpr double radians = 6.283185307 * limits::slowestToneHz;

    struct Channel {
        std::int32_t sum = 0, high = 0, low = 0, oldHigh = 0, oldLow = 0; // since the part began; extremes
        std::array<std::int32_t, partCount> highs{}, lows{};
        std::int32_t slow = 0, speed = 0, loadSum = 0, restingGain = fullRestingGain, endGain = unity;
    };

    // Product a * b, for |a| below 2^27 or 0 <= a, and 0 <= b < 1/32.
    static constexpr std::int32_t scaled(std::int32_t a, double b) noexcept {
        return (a >> 8) * static_cast<std::int32_t>(b * 65536.0 + 0.5) >> 8;
    }

    static std::int32_t updateChannel(Channel& c, std::int32_t tileSum) noexcept {
        c.sum += tileSum;
        c.high = std::max(c.high, c.sum);
        c.low = std::min(c.low, c.sum);
        const std::int32_t area =
            std::max(std::max(c.high, c.oldHigh) - c.sum, c.sum - std::min(c.low, c.oldLow));
        const std::int32_t load = updateLoad(c, tileSum * 32); // a sum of 16, of 2^-15, as a mean of 2^-24
        const std::int32_t allowedGain = std::min(gainOfArea(maxArea - area), gainOfLoad(maxLoad - load));
        c.endGain = std::max(std::int32_t{0}, std::min(allowedGain, c.restingGain >> 15));
        if (area < maxArea / 2 && load < maxLoad / 2)
            c.restingGain = std::min(fullRestingGain, c.restingGain + restingRise);
        else
            c.restingGain -= (c.restingGain - (c.endGain << 15)) / restingFallTiles;
        return c.endGain;
    }

    // Steps the second-order low-pass; returns the mean of its squared output over a second, and half of the
    // energy that is still in it.
    static std::int32_t updateLoad(Channel& c, std::int32_t mean) noexcept {
        constexpr double step = radians / tilesPerSecond, half = 0.5 / radians;
        static_assert(limits::guardDamping == 1.0f, "without a product");
        c.speed += scaled(mean - c.slow - c.speed, step);
        c.slow += scaled(c.speed, step);
        const std::int32_t slow = c.slow >> 10, speed = c.speed >> 10, squared = slow * slow;
        // The sum of the squared output over a second, in 2^-24, so that rounding loses nothing. Its bound
        // is far above maxLoad, where the gain is 0.
        constexpr std::int32_t maxSum = 1 << 30;
        c.loadSum = std::min(maxSum, c.loadSum + (squared >> 4) - c.loadSum / tilesPerSecond);
        return c.loadSum / (tilesPerSecond / 8) * 2 + scaled(squared, limits::guardOfSlow * half) +
               scaled(slow * speed, half) + scaled(speed * speed, limits::guardOfSpeed * half);
    }

    static constexpr std::int32_t gainOfArea(std::int32_t area) noexcept {
        return area >= zoneFrames * unity ? unity : area / zoneFrames;
    }
    static constexpr std::int32_t gainOfLoad(std::int32_t load) noexcept {
        return load >= loadUnit / perLoad ? unity : load <= 0 ? 0 : load * perLoad >> 13;
    }

    // Starts the next part of the 250 ms. Sums restart at 0, so that they stay within 32 bits.
    void endPart() noexcept {
        for (auto& c : channel_) {
            c.highs[part_] = c.high;
            c.lows[part_] = c.low;
            c.oldHigh = c.oldLow = 0;
            for (auto& high : c.highs) c.oldHigh = std::max(c.oldHigh, high -= c.sum);
            for (auto& low : c.lows) c.oldLow = std::min(c.oldLow, low -= c.sum);
            c.sum = c.high = c.low = 0;
        }
        part_ = (part_ + 1) % partCount;
        tileInPart_ = 0;
    }
    void reset() noexcept {
        const auto episodes = episodes_;
        *this = {};
        episodes_ = episodes;
    }

    std::array<Channel, static_cast<std::size_t>(channels)> channel_{};
    std::size_t part_ = 0;
    std::int32_t tileInPart_ = 0, silentTiles_ = forgetTiles, gain_ = unity;
    std::uint32_t episodes_ = 0;
    bool isAtRest_ = true;
};

} // namespace physvib::pico
