// SPDX-License-Identifier: MIT
// Inputs and outputs for people: the LED, and the jumper of the ceiling. LED while waiting: a short flash
// every two seconds; playing: on; limiting (guard or ceiling): eight flashes a second; fault: three flashes,
// then a pause, for five seconds.
#pragma once
#include "FixedGuard.h"

namespace physvib::pico {
enum class Light { waiting, playing, limiting, fault };

/// Main loop only. Times are counts of tiles since power-on.
class Indicator {
public:
    /// Returns what to show. `limited`, `faults`: totals since power-on.
    Light see(std::uint32_t tiles, bool isPlaying, std::uint32_t limited, std::uint32_t faults) noexcept {
        if (limited != limited_) limitedAt_ = tiles, wasLimited_ = true;
        if (faults != faults_) faultAt_ = tiles, wasFault_ = true;
        limited_ = limited;
        faults_ = faults;
        wasLimited_ = wasLimited_ && tiles - limitedAt_ < tilesPerSecond / 2;
        wasFault_ = wasFault_ && tiles - faultAt_ < 5 * tilesPerSecond;
        if (wasFault_) return Light::fault;
        return !isPlaying ? Light::waiting : wasLimited_ ? Light::limiting : Light::playing;
    }

    static bool isOn(Light light, std::uint32_t tiles) noexcept {
        constexpr std::uint32_t second = tilesPerSecond;
        switch (light) {
        case Light::waiting: return tiles % (2 * second) < second / 20;
        case Light::playing: return true;
        case Light::limiting: return tiles % (second / 8) < second / 16;
        case Light::fault: break;
        }
        const auto at = tiles % (3 * second / 2);
        return at < 3 * second / 4 && at % (second / 4) < second / 8;
    }

private:
    std::uint32_t limited_ = 0, faults_ = 0, limitedAt_ = 0, faultAt_ = 0;
    bool wasLimited_ = false, wasFault_ = false;
};

/// The wire from GP9 to ground, which allows full scale; without it the ceiling is a quarter. It counts after
/// a contact of stillTiles, until the first interruption. Main loop only. Times are counts of tiles.
class CeilingJumper {
public:
    static constexpr std::uint32_t stillTiles = tilesPerSecond / 10; // a contact bounces for some 10 ms

    /// True: full scale is allowed.
    bool see(std::uint32_t tiles, bool isTied) noexcept {
        if (!isTied || !wasTied_) tiedAt_ = tiles;
        if (!isTied) isFull_ = false;
        wasTied_ = isTied;
        isFull_ = isFull_ || (isTied && tiles - tiedAt_ >= stillTiles);
        return isFull_;
    }

private:
    std::uint32_t tiedAt_ = 0;
    bool wasTied_ = false, isFull_ = false;
};

} // namespace physvib::pico
