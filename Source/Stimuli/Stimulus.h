// SPDX-License-Identifier: MIT
// Stimuli of studies (pulse patterns and phantoms) as events: amplitudes in g, times from 0.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Core/PhantomPanner.h"
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// One to three consecutive pulses of one duration (thesis 3.2); pulse k plays on actuators[k].
struct PulsePattern {
    double pulseSeconds = 0.0;
    int count = 0;
    std::array<int, 3> actuators{};
    bool operator==(const PulsePattern&) const = default;
};

/// Silence between two pulses of a pattern (thesis 3.2.2).
constexpr double pulseGapSeconds = 0.1;
/// The two pulse durations of the thesis' study.
constexpr std::array<double, 2> pulseDurationsSeconds{0.1, 0.25};

/// All D (E + E^2 + E^3) patterns for E actuators, by duration, then count, then actuators. Message thread.
inline std::vector<PulsePattern> allPulsePatterns(int actuatorCount) {
    std::vector<PulsePattern> patterns;
    for (const double seconds : pulseDurationsSeconds) {
        int combinations = 1;
        for (int count = 1; count <= 3; ++count) {
            combinations *= actuatorCount;
            for (int c = 0; c < combinations; ++c) {
                PulsePattern p{seconds, count, {}};
                for (int k = count - 1, quotient = c; k >= 0; --k, quotient /= actuatorCount)
                    p.actuators[static_cast<std::size_t>(k)] = quotient % actuatorCount;
                patterns.push_back(p);
            }
        }
    }
    return patterns;
}

/// "ABA-250": the actuators' letters by pulse, then a pulse's milliseconds. Actuators 0 to 25. Message
/// thread.
inline std::string patternLabel(const PulsePattern& p) {
    std::string label;
    for (int k = 0; k < p.count; ++k)
        label += static_cast<char>('A' + p.actuators[static_cast<std::size_t>(k)]);
    return label.append("-").append(std::to_string(std::lround(p.pulseSeconds * 1e3)));
}

/// Parses such a label: one to three letters, 1 to 10000 ms; nullopt otherwise. Any thread.
inline std::optional<PulsePattern> parsePatternLabel(std::string_view label) noexcept {
    PulsePattern p;
    while (!label.empty() && label.front() >= 'A' && label.front() <= 'Z') {
        if (p.count == 3) return std::nullopt;
        p.actuators[static_cast<std::size_t>(p.count++)] = label.front() - 'A';
        label.remove_prefix(1);
    }
    int milliseconds = 0;
    if (p.count == 0 || !label.starts_with('-')) return std::nullopt;
    const auto [end, error] = std::from_chars(label.data() + 1, label.data() + label.size(), milliseconds);
    if (error != std::errc{} || end != label.data() + label.size() || milliseconds < 1 ||
        milliseconds > 10000)
        return std::nullopt;
    p.pulseSeconds = milliseconds * 1e-3;
    return p;
}

/// A place on the response field: x to the right, y downwards, both from 0 to 1.
struct FieldPlace {
    double x = 0.0, y = 0.0;
    bool operator==(const FieldPlace&) const = default;
};

/// Frequency and level of all stimuli of a set (thesis 3.2.1, Eq. 4.1).
struct Carrier {
    double frequencyHz = 205.0; ///< resonance of the thesis' LRA
    double levelG = 1.0;        ///< peak acceleration of an actuator at gain 1
};

/// Events in time order, and their panner. Amplitude 1 is 1 g: the drive of a channel is its samples divided
/// by the actuator's full scale in g.
struct Stimulus {
    std::vector<CollisionEvent> events;
    PhantomPanner panner;
    double seconds = 0.0; ///< from 0 to the end of the last event
};

/// Each pulse is a rectangular burst on one actuator alone, whatever the layout. `actuatorCount`: number of
/// actuators, 1 to 26, at least those that the pattern names. Message thread.
Stimulus patternStimulus(const PulsePattern& pattern, int actuatorCount, const Carrier& carrier,
                         double gapSeconds = pulseGapSeconds);

/// A stationary phantom at `place` of the layout's extent, all actuators in phase (Eq. 4.1 to 4.3). Message
/// thread.
Stimulus phantomStimulus(const FieldPlace& place, const ActuatorLayout& layout, PanningLaw law,
                         double exponent, const Carrier& carrier, double seconds = 1.0);

/// A layout of `count` actuators in which each has gain 1 at its own place and 0 at those of all others:
/// exactly for up to four, below -250 dB for more. Any thread.
ActuatorLayout separatedLayout(int count) noexcept;

/// Level of a played stimulus on its strongest actuator, after master level, strips and ceilings.
struct PlayedLevel {
    double peakG = 0.0, rmsG = 0.0; ///< rmsG: over the stimulus' duration
    bool operator==(const PlayedLevel&) const = default;
};

} // namespace physvib
