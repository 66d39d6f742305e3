// SPDX-License-Identifier: GPL-3.0-or-later
// What becomes of an onset: a strike on each enchanter of its band.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Core/Limits.h"
#include "Host/Music/BeatBands.h"
#include <array>
#include <bitset>
#include <string_view>

namespace physvib {

using EnchanterSet = std::bitset<limits::maxEnchanters>;

/// How beats are felt.
struct BeatVoices {
    static constexpr double usualLevel = 0.5;

    std::array<EnchanterSet, beatBands.size()> enchanters; ///< of each band; none: it is not felt
    /// the resonance of the thesis' actuator
    std::array<double, beatBands.size()> frequencyHz{205.0, 205.0, 205.0};
    std::array<double, beatBands.size()> decayPerSecond{15.0, 30.0, 60.0}; ///< long, short, a tick
    double level = usualLevel; ///< peak of the strongest at gain 1, in shares of full scale
};

/// Low on the first, high on the last, mid on those between (or, of two, on the last). Any thread, R too.
std::array<EnchanterSet, beatBands.size()> usualBeatEnchanters(int count) noexcept;

/// "AC"; false if one is no enchanter of `count`, or named twice. Any thread.
bool parseEnchanters(std::string_view letters, int count, EnchanterSet& enchanters);

/// Calls `strike(const CollisionEvent&)` for each enchanter of the onset's band, at `timeNs`, where it sits
/// on a field of that size. Any thread, R too.
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
