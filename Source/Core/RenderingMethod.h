// SPDX-License-Identifier: MIT
// Rendering method: which of amplitude, frequency and decay follow the collision and which are fixed (the
// eight renderings of the thesis' study 2, 5.3).
#pragma once
#include "Core/CollisionEvent.h"
#include <array>
#include <string_view>

namespace physvib {

/// A{V,F}-F{V,F}-DR{V,F}: amplitude, frequency and decay are varied (from physics) or fixed. The call
/// operator turns a collision into the event that is rendered; AV-FV-DRV changes nothing. Any thread.
struct RenderingMethod {
    static constexpr double fixedLevelG = 1.5; ///< acceleration in g; divide by the full scale in g for an
                                               ///< amplitude
    static constexpr double fixedFrequencyHz = 250.0;
    static constexpr std::int64_t fixedPulseNs = 20'000'000; ///< rectangular envelope: five periods of 250
                                                             ///< Hz; other frequencies are cut in mid-period

    bool fixesAmplitude = false;
    bool fixesFrequency = false;
    bool fixesDecay = false;
    double fixedAmplitude = fixedLevelG; ///< 1 = full scale of an actuator, as in an event
    bool holdsLevel = false; ///< true: fixedAmplitude is the peak of the summed vibration, not each impact's
                             ///< A of Eq. 5.1 (FixedLevel.h)

    constexpr CollisionEvent operator()(CollisionEvent event) const noexcept {
        if (fixesAmplitude) event.amplitude = fixedAmplitude;
        if (fixesFrequency) event.frequencyHz = fixedFrequencyHz;
        if (!fixesDecay) return event;
        event.decayPerSecond = 0.0;
        event.durationNs = fixedPulseNs;
        return event;
    }
    constexpr bool fixesNothing() const noexcept { return !fixesAmplitude && !fixesFrequency && !fixesDecay; }
    bool operator==(const RenderingMethod&) const = default;
};

/// Parses a name like "AF-FV-DRF"; false, and `method` unchanged, if there is no such method. Any thread.
constexpr bool renderingMethodNamed(std::string_view name, RenderingMethod& method) noexcept {
    constexpr std::string_view varied = "AV-FV-DRV";
    constexpr std::size_t choices[] = {1, 4, 8}; // where V or F stands
    bool fixes[3] = {};
    if (name.size() != varied.size()) return false;
    for (std::size_t i = 0, next = 0; i < varied.size(); ++i) {
        const bool isChoice = next < 3 && i == choices[next];
        if (isChoice) fixes[next++] = name[i] == 'F';
        if (name[i] != varied[i] && !(isChoice && name[i] == 'F')) return false;
    }
    method.fixesAmplitude = fixes[0];
    method.fixesFrequency = fixes[1];
    method.fixesDecay = fixes[2];
    return true;
}

/// The method's name. Any thread.
constexpr std::array<char, 9> nameOf(const RenderingMethod& method) noexcept {
    std::array<char, 9> name{'A', 'V', '-', 'F', 'V', '-', 'D', 'R', 'V'};
    if (method.fixesAmplitude) name[1] = 'F';
    if (method.fixesFrequency) name[4] = 'F';
    if (method.fixesDecay) name[8] = 'F';
    return name;
}

} // namespace physvib
