// SPDX-License-Identifier: MIT
// What the LED shows, and the jumper that sets the ceiling. The LED flashes briefly every two seconds while
// waiting, is on while playing, flashes eight times a second while guard or ceiling limit, and for five
// seconds after an error in groups of three.
#pragma once
#include "FixedGuard.h"

namespace physvib::pico {
enum class Light { waiting, playing, limiting, error };

/// Main loop only. Times are counts of tiles since power-on.
class Indicator {
public:
    /// Returns what to show. `limited`, `errors`: totals since power-on.
    Light update(std::uint32_t tiles, bool isPlaying, std::uint32_t limited, std::uint32_t errors) noexcept {
        if (limited != lastLimited_) limitedTile_ = tiles, isLimiting_ = true;
        if (errors != lastErrors_) errorTile_ = tiles, hasError_ = true;
        lastLimited_ = limited;
        lastErrors_ = errors;
        isLimiting_ = isLimiting_ && tiles - limitedTile_ < tilesPerSecond / 2;
        hasError_ = hasError_ && tiles - errorTile_ < 5 * tilesPerSecond;
        if (hasError_) return Light::error;
        return !isPlaying ? Light::waiting : isLimiting_ ? Light::limiting : Light::playing;
    }

    static bool isOn(Light light, std::uint32_t tiles) noexcept {
        constexpr std::uint32_t second = tilesPerSecond;
        switch (light) {
        case Light::waiting: return tiles % (2 * second) < second / 20;
        case Light::playing: return true;
        case Light::limiting: return tiles % (second / 8) < second / 16;
        case Light::error: break;
        }
        const auto phase = tiles % (3 * second / 2);
        return phase < 3 * second / 4 && phase % (second / 4) < second / 8;
    }

private:
    std::uint32_t lastLimited_ = 0, lastErrors_ = 0, limitedTile_ = 0, errorTile_ = 0;
    bool isLimiting_ = false, hasError_ = false;
};

/// The wire from GP9 to ground, which allows full scale; without it the ceiling is a quarter. It is effective
/// after debounceTiles of contact, until the contact first opens. Main loop only. Times are counts of tiles.
class CeilingJumper {
public:
    static constexpr std::uint32_t debounceTiles = tilesPerSecond / 10; // a contact bounces for some 10 ms

    /// True: full scale is allowed.
    bool update(std::uint32_t tiles, bool isGrounded) noexcept {
        if (!isGrounded || !wasGrounded_) groundedTile_ = tiles;
        if (!isGrounded) isFullScale_ = false;
        wasGrounded_ = isGrounded;
        isFullScale_ = isFullScale_ || (isGrounded && tiles - groundedTile_ >= debounceTiles);
        return isFullScale_;
    }

private:
    std::uint32_t groundedTile_ = 0;
    bool wasGrounded_ = false, isFullScale_ = false;
};

} // namespace physvib::pico
