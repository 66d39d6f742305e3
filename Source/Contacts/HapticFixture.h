// SPDX-License-Identifier: MIT
// What PhysVib must know of a fixture: the thesis' user data (Fig. 5.1), kept beside the engine's own.
#pragma once
#include "Contacts/Voice.h"
#include "Core/Limits.h"
#include <cstdint>
#include <string_view>

namespace physvib {

/// Contact sound and camera flag of one fixture. The engine's user data stay the user's.
struct HapticFixture {
    double frequencyHz = 0.0; ///< 0: silent, but felt by what it strikes
    double decayPerSecond = 0.0;
    bool isCamera = false;
    double staticMassKg = 0.0; ///< mass for Eq. 5.4 if the body is not dynamic; a dynamic body has its own
    Voice voice = Voice::own;  ///< of a camera; without a partner that sounds: own
};

/// What is wrong with values, and what was expected; empty if they can be used. Any thread.
inline std::string_view faultOf(const HapticFixture& values) noexcept {
    constexpr auto isWithin = [](double value, double most) { return value >= 0.0 && value <= most; }; // not NaN
    if (!isWithin(values.frequencyHz, limits::maxFrequencyHz)) return "frequency: expected 0 to 20000 Hz";
    if (!isWithin(values.decayPerSecond, limits::maxDecayPerSecond)) return "decay: expected 0 to 2000 per second";
    if (!isWithin(values.staticMassKg, 1.0e12)) return "mass: expected 0 to 10^12 kg";
    return {};
}

/// What became of values that were given to a fixture.
struct SetResult {
    std::int32_t id = -1;     ///< of the fixture in events; -1: refused, and nothing has changed
    std::string_view refusal; ///< why; empty: they are set
    explicit operator bool() const noexcept { return refusal.empty(); }
};

} // namespace physvib
