// SPDX-License-Identifier: MIT
// Strikes on enchanters, their samples by the closed form, and how far two sounds are apart.
#pragma once
#include "Core/ClockLaw.h"
#include "Core/CollisionEvent.h"
#include "Core/PhantomPanner.h"
#include "Formats/StrikeClip.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace physvib::test {

constexpr int rateHz = EventClipSettings::ticksPerSecond;

inline PhantomPanner panner() {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    return {layout, PanningLaw::linear, 1.0, 1.0, 1.0};
}

inline Clip clipOf(std::span<const CollisionEvent> events, double error,
                   const PhantomPanner& spread = panner()) {
    EventClipSettings settings{
        error, static_cast<std::size_t>(spread.channels()),
        [&](const CollisionEvent& e, PhantomPanner::Gains& gains) { spread.gainsAt(e.x, e.y, gains); }};
    return clipFromEvents(events, settings);
}

/// Two materials, hits that fall into each other's ringing, between ticks; every fourth is cut.
inline std::vector<CollisionEvent> hits(int count) {
    std::mt19937 random{7};
    const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
    std::vector<CollisionEvent> events;
    for (int k = 0; k < count; ++k) {
        CollisionEvent e{static_cast<std::int64_t>(1e9 * (0.05 * k + 0.04 * share())),
                         k % 2 ? 80.0 : 349.0,
                         k % 2 ? 30.0 : 55.0,
                         0.02 + 0.2 * share(),
                         share(),
                         share()};
        if (k % 4 == 3) e.durationNs = 31'234'567;
        events.push_back(e);
    }
    return events;
}

/// What Docs/events.md says that a sample is.
inline std::vector<std::vector<double>> closedForm(std::span<const CollisionEvent> events, std::size_t frames,
                                                   const PhantomPanner& spread = panner()) {
    std::vector<std::vector<double>> out(static_cast<std::size_t>(spread.channels()),
                                         std::vector<double>(frames));
    const FrameClock clock{rateHz};
    for (const CollisionEvent& e : events) {
        PhantomPanner::Gains gains{};
        spread.gainsAt(e.x, e.y, gains);
        const auto onset = clock.at(e.timeNs);
        const auto end = e.durationNs > 0 ? std::min<std::int64_t>(clock.at(e.timeNs + e.durationNs).frame,
                                                                   static_cast<std::int64_t>(frames))
                                          : static_cast<std::int64_t>(frames);
        for (std::int64_t n = onset.frame; n < end; ++n) {
            const double t = (static_cast<double>(n - onset.frame) + onset.leadFrames) / rateHz;
            const double x = e.amplitude * std::sin(2.0 * std::numbers::pi * e.frequencyHz * t) *
                             std::exp(-e.decayPerSecond * t);
            for (std::size_t j = 0; j < out.size(); ++j) out[j][static_cast<std::size_t>(n)] += gains[j] * x;
        }
    }
    return out;
}

template <class A, class B>
double farthest(const std::vector<A>& a, const std::vector<B>& b) {
    double most = 0.0;
    for (std::size_t j = 0; j < std::min(a.size(), b.size()); ++j)
        for (std::size_t n = 0; n < std::max(a[j].size(), b[j].size()); ++n)
            most = std::max(most, std::abs((n < a[j].size() ? static_cast<double>(a[j][n]) : 0.0) -
                                           (n < b[j].size() ? static_cast<double>(b[j][n]) : 0.0)));
    return most;
}

} // namespace physvib::test
