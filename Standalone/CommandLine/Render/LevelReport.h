// SPDX-License-Identifier: GPL-3.0-or-later
// Levels in words: in dB of full scale and in g.
#pragma once
#include "Calls/LoadedRender.h"
#include "Core/Limits.h"
#include "Core/Units.h"
#include "Io/Text/NumberText.h"
#include "Pictures/WaveformEnvelope.h"
#include "Scene/SilentWords.h"
#include <algorithm>
#include <cmath>
#include <string>

namespace physvib {

inline std::string inG(double g) { return fixedNumber(g, g < 0.1 ? 4 : 2) + " g"; }

/// "peak -6.0 dBFS (0.50 g)", g that of the enchanter that moves most. An equalised channel holds drive: what
/// is felt is what was asked for, not what stands in the file.
inline std::string peakWords(const LoadedRender& job, const WaveformEnvelope& whole) {
    if (!(whole.peak() > 0.0f)) {
        const std::string why =
            job.clip ? "" : silentWords(job.made.events, job.panner(), job.hasGuessedField(), job.endNs());
        return "silent" + (why.empty() ? "" : ": " + why);
    }
    std::string words = "peak " + fixedNumber(toDecibels(static_cast<double>(whole.peak())), 1) + " dBFS";
    const auto equalised = job.equalised();
    if (std::ranges::any_of(equalised, &EqualisedActuator::isKnown)) return "drive " + words;
    double most = 0.0;
    for (int j = 0; j < whole.channels(); ++j)
        most = std::max(
            most,
            static_cast<double>(whole.peak(j)) *
                job.layout.enchanters[std::min(static_cast<std::size_t>(j), job.layout.enchanters.size() - 1)]
                    .fullScaleG);
    return words + " (" + inG(most) + ")";
}

/// "48 collisions, 0.0020 g to 0.42 g, 3 under one step of an 8-bit converter": of each event, the enchanter
/// that gets most of it.
inline std::string collisionWords(const LoadedRender& job) {
    constexpr double step = 1.0 / 128.0; // of full scale: the board's converters
    const auto& events = job.made.events;
    std::string words = counted(events.size(), "collision");
    if (events.empty()) return words;
    const PhantomPanner panner = job.panner();
    PhantomPanner::Gains gains{};
    double least = HUGE_VAL, most = 0.0;
    std::size_t under = 0;
    for (const CollisionEvent& e : events) {
        panner.gainsOf(e, Spread::layout, gains);
        double level = 0.0, g = 0.0;
        for (std::size_t j = 0;
             j < std::min(static_cast<std::size_t>(panner.channels()), job.layout.enchanters.size()); ++j) {
            level = std::max(level, std::abs(e.amplitude * gains[j]));
            g = std::max(g, std::abs(e.amplitude * gains[j]) * job.layout.enchanters[j].fullScaleG);
        }
        least = std::min(least, g);
        most = std::max(most, g);
        under += level < step ? 1 : 0;
    }
    return words + ", " + inG(least) + " to " + inG(most) + ", " + std::to_string(under) +
           " under one step of an 8-bit converter";
}

} // namespace physvib
