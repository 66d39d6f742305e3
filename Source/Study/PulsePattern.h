// SPDX-License-Identifier: MIT
// Spatiotemporal patterns: one to three pulses, each on one enchanter (thesis 3.2).
#pragma once
#include <array>
#include <vector>

namespace physvib {

/// Pulses of one duration, one after the other; `enchanters[0..count)` says which enchanter each is on.
struct PulsePattern {
    double pulseSeconds = 0.0;
    int count = 0;
    std::array<int, 3> enchanters{};
    bool operator==(const PulsePattern&) const = default;
};

/// Silence between two pulses of a pattern (thesis 3.2.2).
constexpr double pulseGapSeconds = 0.1;
/// The two pulse durations of the thesis' study.
constexpr std::array<double, 2> pulseDurationsSeconds{0.1, 0.25};

/// All D (E + E^2 + E^3) patterns for E enchanters, by duration, then count, then enchanters. M only (allocates).
inline std::vector<PulsePattern> allPulsePatterns(int enchanterCount) {
    std::vector<PulsePattern> patterns;
    for (const double seconds : pulseDurationsSeconds) {
        int combinations = 1;
        for (int count = 1; count <= 3; ++count) {
            combinations *= enchanterCount;
            for (int c = 0; c < combinations; ++c) {
                PulsePattern p{seconds, count, {}};
                for (int k = count - 1, rest = c; k >= 0; --k, rest /= enchanterCount)
                    p.enchanters[static_cast<std::size_t>(k)] = rest % enchanterCount;
                patterns.push_back(p);
            }
        }
    }
    return patterns;
}

/// Length of a pattern from the first onset to the last end.
constexpr double patternSeconds(const PulsePattern& p) noexcept {
    return p.count * p.pulseSeconds + (p.count - 1) * pulseGapSeconds;
}

} // namespace physvib
