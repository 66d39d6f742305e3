// SPDX-License-Identifier: MIT
// What a render must be: the sum of Eq. 5.1 over all events, in double precision with library functions,
// written without any of the renderer's code but the event type. Gains come from the caller.
#pragma once
#include "Core/CollisionEvent.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace physvib::test {

using Signal = std::vector<std::vector<double>>; // [channel][frame]
using GainLaw = std::function<void(double x, double y, double* gains)>;

/// sum of A g_j sin(2 pi f t) exp(-tau t), t = n/rate - t_e, over events with t_e <= n/rate (< t_e +
/// duration).
inline Signal closedForm(const std::vector<CollisionEvent>& events, int rate, int channels, int frames,
                         const GainLaw& law) {
    Signal sum(static_cast<std::size_t>(channels), std::vector<double>(static_cast<std::size_t>(frames)));
    std::vector<double> gains(64);
    for (const auto& e : events) {
        law(e.x, e.y, gains.data());
        for (std::int64_t n = e.timeNs * rate / 1'000'000'000; n < frames; ++n) {
            const std::int64_t sinceNsTimesRate = n * 1'000'000'000 - e.timeNs * rate; // exact
            if (sinceNsTimesRate < 0) continue;
            if (e.durationNs > 0 && sinceNsTimesRate >= e.durationNs * rate) break;
            const double t = static_cast<double>(sinceNsTimesRate) * 1e-9 / rate;
            if (e.decayPerSecond * t > 16.2) break; // -140.7 dB
            const double x = e.amplitude * std::sin(2.0 * std::numbers::pi * e.frequencyHz * t) *
                             std::exp(-e.decayPerSecond * t);
            for (std::size_t j = 0; j < sum.size(); ++j) sum[j][static_cast<std::size_t>(n)] += gains[j] * x;
        }
    }
    return sum;
}

/// Largest difference, relative to the larger of 1 and the expected peak.
inline double relativeError(const Signal& expected, const std::vector<std::vector<float>>& actual) {
    double peak = 1.0, error = 0.0;
    for (std::size_t j = 0; j < expected.size(); ++j)
        for (std::size_t n = 0; n < expected[j].size(); ++n) {
            peak = std::max(peak, std::abs(expected[j][n]));
            error = std::max(error, std::abs(expected[j][n] - static_cast<double>(actual[j][n])));
        }
    return error / peak;
}

/// Seeded random numbers that are the same with every library.
class Random {
public:
    explicit Random(std::uint32_t seed)
        : engine_{seed} {}
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    double logUniform(double low, double high) { return low * std::pow(high / low, uniform(0.0, 1.0)); }
    int below(int count) { return static_cast<int>(uniform(0.0, count)); }

private:
    std::mt19937 engine_;
};

/// `count` events in time order within `seconds`: f 20-1000 Hz, tau 0.5-150 /s, anywhere between frames; one
/// in five has a duration, half of them share `materials` (frequency, decay) pairs.
inline std::vector<CollisionEvent> randomEvents(int count, double seconds, std::uint32_t seed,
                                                int materials = 8) {
    Random random{seed};
    std::vector<std::pair<double, double>> shared;
    for (int m = 0; m < materials; ++m)
        shared.emplace_back(random.logUniform(20, 1000), random.logUniform(0.5, 150));
    std::vector<CollisionEvent> events(static_cast<std::size_t>(count));
    for (auto& e : events) {
        e.timeNs = static_cast<std::int64_t>(random.uniform(0, seconds) * 1e9);
        e.frequencyHz = random.logUniform(20, 1000);
        e.decayPerSecond = random.logUniform(0.5, 150);
        if (materials > 0 && random.below(2) == 0)
            std::tie(e.frequencyHz, e.decayPerSecond) =
                shared[static_cast<std::size_t>(random.below(materials))];
        e.amplitude = random.uniform(0.01, 1.0);
        e.x = random.uniform(0, 1);
        e.y = random.uniform(0, 1);
        if (random.below(5) == 0) e.durationNs = static_cast<std::int64_t>(random.uniform(0.001, 0.5) * 1e9);
    }
    std::ranges::stable_sort(events, {}, &CollisionEvent::timeNs);
    return events;
}

} // namespace physvib::test
