// SPDX-License-Identifier: MIT
// What PhysVib must know of a fixture: the thesis' user data (Fig. 5.1), kept beside the engine's own.
#pragma once
#include "Contacts/Texture.h"
#include "Contacts/Voice.h"
#include "Core/Limits.h"
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace physvib {

/// A mode that sounds together with a first one.
struct Overtone {
    double frequencyHz = 0.0;       ///< 0: none
    double decayPerSecond = 0.0;    ///< of this mode
    double relativeAmplitude = 1.0; ///< to the first mode's
};
using Overtones = std::array<Overtone, 3>; ///< more of them, struck at once, are felt as one anyway

/// Contact sound and camera flag of one fixture. The engine's user data stay the user's.
struct HapticFixture {
    double frequencyHz = 0.0;    ///< 0: silent, but felt by what it strikes
    double decayPerSecond = 0.0; ///< of its vibration
    bool isCamera = false;       ///< its collisions are felt
    double staticMassKg = 0.0;   ///< mass for Eq. 5.4 if the body is not dynamic; a dynamic body has its own
    Voice voice = Voice::own;    ///< of a camera; without a partner that sounds: own
    Overtones overtones{};       ///< further modes
    int surface = 0;             ///< its kind, for sounds of pairs (see PairSounds); 0: none
    double gain = 1.0; ///< of what it sends out as a camera; 0: muted, and it may be felt again at any time
    Texture texture{}; ///< for what rolls and slides along it
    std::optional<double> handMassKg{}; ///< m_h of Eq. 5.4 for this camera, instead of the settings'
};

/// True if an impact could never be played with it: it would not fade, or hold a coil at nearly direct
/// current. Any thread.
constexpr bool isEndless(double frequencyHz, double decayPerSecond) noexcept {
    return frequencyHz > 0.0 && !(decayPerSecond > 0.0 && (frequencyHz >= limits::slowestToneHz ||
                                                           decayPerSecond >= limits::slowDecayPerSecond));
}

/// What is wrong with values, and what was expected; empty if they can be used. Any thread.
inline std::string_view faultOf(const HapticFixture& values) noexcept {
    // not NaN
    constexpr auto isWithin = [](double value, double most) { return value >= 0.0 && value <= most; };
    if (!isWithin(values.frequencyHz, limits::maxFrequencyHz)) return "frequency: expected 0 to 20000 Hz";
    if (!isWithin(values.decayPerSecond, limits::maxDecayPerSecond))
        return "decay: expected 0 to 2000 per second";
    if (isEndless(values.frequencyHz, values.decayPerSecond))
        return "decay: expected more than 0 per second (below 5 Hz at least 1), else the frequency is never "
               "felt";
    if (!isWithin(values.staticMassKg, 1.0e12)) return "mass: expected 0 to 10^12 kg";
    for (const Overtone& mode : values.overtones) {
        if (!isWithin(mode.frequencyHz, limits::maxFrequencyHz))
            return "overtone's frequency: expected 0 to 20000 Hz";
        if (!isWithin(mode.decayPerSecond, limits::maxDecayPerSecond))
            return "overtone's decay: expected 0 to 2000 per second";
        if (isEndless(mode.frequencyHz, mode.decayPerSecond))
            return "overtone's decay: expected more than 0 per second (below 5 Hz at least 1), else it is "
                   "never felt";
        if (!isWithin(mode.relativeAmplitude, 1000.0))
            return "overtone's amplitude: expected 0 to 1000 of the first mode's";
    }
    if (!isWithin(values.gain, 1.0e6)) return "gain: expected 0 to 10^6";
    if (!isWithin(values.handMassKg.value_or(0.0), 1.0e12)) return "hand mass: expected 0 to 10^12 kg";
    return faultOf(values.texture);
}

/// What became of values that were given to a fixture.
struct [[nodiscard]] SetResult {
    std::int32_t id = -1;     ///< of the fixture in events; -1: refused, and nothing has changed
    std::string_view refusal; ///< why; empty: they are set
    explicit operator bool() const noexcept { return refusal.empty(); } ///< Done.
};

} // namespace physvib
