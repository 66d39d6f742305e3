// SPDX-License-Identifier: MIT
// Holds the summed amplitude of overlapping impacts at a fixed level, whatever their number and materials.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/RenderingMethod.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace physvib {

/// The largest value of sin(2 pi f t) exp(-tau t), a little before its first quarter period. Any thread.
inline double peakOfDecay(double frequencyHz, double decayPerSecond) noexcept {
    const double turn = 2.0 * std::numbers::pi * frequencyHz, phase = std::atan2(turn, decayPerSecond);
    return std::sin(phase) * std::exp(-decayPerSecond * phase / turn);
}

/// Impacts of one world, in time order. An impact from rest peaks at the fixed amplitude. A later one adds
/// only what the sounding ones leave free, so that the sum never exceeds the level, on one actuator or on
/// all. One thread at a time; never allocates.
class FixedLevel {
public:
    /// Events without a causing fixture or without a frequency stay unchanged.
    CollisionEvent operator()(CollisionEvent event, const RenderingMethod& method) noexcept {
        if (!method.holdsLevel || !method.fixesAmplitude || event.source.fixture < 0 ||
            !(event.frequencyHz > 0.0))
            return event;
        const double left = std::max(0.0, method.fixedAmplitude - soundingAt(event.timeNs));
        event.amplitude = left / peakOfDecay(event.frequencyHz, event.decayPerSecond);
        if (left > 0.0) add(event);
        return event;
    }
    void forget() noexcept { sounding_ = {}; }

private:
    struct Envelope {
        double level = 0.0, decayPerSecond = 0.0;
        std::int64_t sinceNs = 0, untilNs = 0;

        double at(std::int64_t timeNs) const noexcept {
            return timeNs >= untilNs
                       ? 0.0
                       : level * std::exp(-1e-9 * decayPerSecond * static_cast<double>(timeNs - sinceNs));
        }
    };

    double soundingAt(std::int64_t timeNs) const noexcept {
        double sum = 0.0;
        for (const Envelope& e : sounding_) sum += e.at(timeNs);
        return sum;
    }

    /// Uses the entry with the lowest level. There are more entries than materials that sound at once, so the
    /// replaced envelope has practically decayed.
    void add(const CollisionEvent& event) noexcept {
        const std::int64_t untilNs = event.durationNs > 0 ? event.timeNs + event.durationNs : INT64_MAX;
        const auto isSame = [&](const Envelope& e) {
            return e.untilNs == INT64_MAX && untilNs == INT64_MAX && e.decayPerSecond == event.decayPerSecond;
        };
        auto at = std::find_if(sounding_.begin(), sounding_.end(), isSame);
        if (at == sounding_.end())
            at = std::min_element(sounding_.begin(), sounding_.end(),
                                  [&](const Envelope& a, const Envelope& b) {
                                      return a.at(event.timeNs) < b.at(event.timeNs);
                                  });
        // The level of the replaced envelope is kept, though its decay then differs.
        const double rest = at->at(event.timeNs);
        *at = {rest + event.amplitude, event.decayPerSecond, event.timeNs, untilNs};
    }

    std::array<Envelope, 16> sounding_{};
};

} // namespace physvib
