// SPDX-License-Identifier: GPL-3.0-or-later
// Turns an onset in music into an event on each actuator of its band.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Core/Limits.h"
#include <array>
#include <bitset>
#include <cstdint>
#include <string_view>

namespace physvib {

struct BeatBand {
    std::string_view name;
    double lowHz = 0.0, highHz = 0.0;
};

/// Bass drum and bass; melody and body of the snare; cymbals and hi-hats. The gaps between are left out,
/// because every instrument has energy there.
inline constexpr std::array<BeatBand, 3> beatBands{
    {{"low", 30.0, 150.0}, {"mid", 200.0, 2500.0}, {"high", 6000.0, 16000.0}}};

/// An onset in one band.
struct BandOnset {
    std::int64_t frame = 0; ///< of the input, from 0
    int band = 0;           ///< index into beatBands
    double strength = 0.0;  ///< of the strongest onset of that band in the last seconds; above 0, up to 1
    bool operator==(const BandOnset&) const = default;
};

using EnchanterSet = std::bitset<limits::maxEnchanters>;

/// Vibration of the beats, per band.
struct BeatVoices {
    static constexpr double usualLevel = 0.5;

    std::array<EnchanterSet, beatBands.size()> enchanters; ///< of each band; none: the band is not felt
    /// resonance of the thesis' actuator
    std::array<double, beatBands.size()> frequencyHz{205.0, 205.0, 205.0};
    std::array<double, beatBands.size()> decayPerSecond{15.0, 30.0, 60.0}; ///< long, short, tick
    double level = usualLevel; ///< peak of the strongest onset at gain 1, 1 = full scale
};

/// Low band on the first actuator, high on the last, mid on those between (with two: on the last). Any
/// thread, R too.
std::array<EnchanterSet, beatBands.size()> usualBeatEnchanters(int count) noexcept;

/// Parses letters such as "AC"; false if one is not among `count` actuators or occurs twice. Any thread.
bool parseEnchanters(std::string_view letters, int count, EnchanterSet& enchanters);

/// Calls `strike(const CollisionEvent&)` for each actuator of the onset's band, at `timeNs` and at the
/// actuator's place in a field of that size. Any thread, R too.
template <class Strike>
void strikeBeat(const BandOnset& onset, std::int64_t timeNs, const BeatVoices& voices,
                const EnchanterLayout& layout, double fieldWidthMetres, double fieldHeightMetres,
                Strike&& strike) {
    const auto band = static_cast<std::size_t>(onset.band);
    for (int j = 0; j < layout.count; ++j) {
        if (!voices.enchanters[band][static_cast<std::size_t>(j)]) continue;
        const EnchanterPlace& place = layout.places[static_cast<std::size_t>(j)];
        CollisionEvent event;
        event.timeNs = timeNs;
        event.frequencyHz = voices.frequencyHz[band];
        event.decayPerSecond = voices.decayPerSecond[band];
        event.amplitude = voices.level * onset.strength;
        event.x = place.xMetres / layout.extentWidthMetres * fieldWidthMetres;
        event.y = place.yMetres / layout.extentHeightMetres * fieldHeightMetres;
        strike(event);
    }
}

} // namespace physvib
