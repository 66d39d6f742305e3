// SPDX-License-Identifier: MIT
// Haptic values of a fixture: its sound, texture and source flag (the thesis' user data, Fig. 5.1).
#pragma once
#include "Contacts/Grains.h"
#include "Core/Limits.h"
#include "Core/NameNumbers.h"
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace physvib {

/// The sound of an impact. own: that of the haptic source; other: that of the body that collides with it;
/// both: one each.
enum class Voice { own, other, both };

/// A mode that sounds together with the first one.
struct Overtone {
    double frequencyHz = 0.0;       ///< 0: none
    double decayPerSecond = 0.0;    ///< of this mode
    double relativeAmplitude = 1.0; ///< relative to the first mode
};
using Overtones = std::array<Overtone, 3>; ///< further simultaneous modes would not be distinguished by touch

/// Values of one fixture. They are kept apart from the engine's user data, which remain the user's.
struct HapticFixture {
    double frequencyHz = 0.0; ///< 0: silent itself, but impacts with it can sound by the other body's voice
    double decayPerSecond = 0.0; ///< of its vibration
    bool isCamera = false;       ///< haptic source: its impacts are felt
    double staticMassKg = 0.0;   ///< mass for Eq. 5.4 if the body is not dynamic; a dynamic body has its own
    Voice voice = Voice::own;    ///< of a haptic source; if the other body has no sound: own
    Overtones overtones{};       ///< further modes
    int surface = 0;             ///< kind of surface, for pair sounds (see PairSounds); 0: none
    double gain = 1.0;           ///< of its events as a haptic source; 0: muted until it is raised again
    Texture texture{};           ///< for bodies that roll and slide along it
    std::optional<double> handMassKg{}; ///< m_h of Eq. 5.4 for this haptic source, instead of the settings'
    SoundNumber sound = 0;              ///< of events of its first mode, for which there may be a recording
    PartNumber part = 0; ///< part of the body on whose actuators this haptic source is felt; 0: on all, by
                         ///< its place
};

/// True if an impact with these values could not be played: it would not decay, or drive a coil with nearly
/// direct current. Any thread.
constexpr bool isEndless(double frequencyHz, double decayPerSecond) noexcept {
    return frequencyHz > 0.0 && !(decayPerSecond > 0.0 && (frequencyHz >= limits::slowestToneHz ||
                                                           decayPerSecond >= limits::slowDecayPerSecond));
}

/// The error of a value, with what was expected; empty if all are valid. Any thread.
inline std::string_view errorOf(const HapticFixture& values) noexcept {
    // false for NaN
    constexpr auto isWithin = [](double value, double max) { return value >= 0.0 && value <= max; };
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
    if (values.sound < 0) return "sound: expected a number from 0 on";
    if (values.part < 0) return "part: expected a number from 0 on";
    return errorOf(values.texture);
}

/// Result of assigning values to a fixture.
struct [[nodiscard]] SetResult {
    std::int32_t id = -1;     ///< the fixture's id in events; -1: refused, and nothing has changed
    std::string_view refusal; ///< the reason; empty: the values are set
    explicit operator bool() const noexcept { return refusal.empty(); } ///< True if the values are set.
};

/// The sound of a haptic source when a fixture of the other kind collides with it, whatever its voice.
struct PairSound {
    double frequencyHz = 0.0;    ///< 0: silent
    double decayPerSecond = 0.0; ///< of that mode
    Overtones overtones{};       ///< further modes
    double gain = 1.0;           ///< factor on the source's gain
    SoundNumber sound = 0;       ///< of events of the first mode, for which there may be a recording
};

/// Sounds of pairs of surface kinds (HapticFixture::surface), in any order. World thread (M).
class PairSounds {
public:
    /// Sets or replaces the sound of a pair. Returns the error (nothing is changed) or empty. Allocates.
    std::string_view set(int surface, int other, const PairSound& sound) {
        if (surface <= 0 || other <= 0) return "surface: expected more than 0";
        if (const std::string_view error = errorOf({.frequencyHz = sound.frequencyHz,
                                                    .decayPerSecond = sound.decayPerSecond,
                                                    .overtones = sound.overtones,
                                                    .gain = sound.gain,
                                                    .sound = sound.sound});
            !error.empty())
            return error;
        sounds_.insert_or_assign(std::minmax(surface, other), sound);
        return {};
    }

    /// nullptr: the pair has no sound of its own.
    const PairSound* find(int surface, int other) const noexcept {
        const auto entry = sounds_.find(std::minmax(surface, other));
        return entry != sounds_.end() ? &entry->second : nullptr;
    }

private:
    std::map<std::pair<int, int>, PairSound> sounds_; // the smaller number first
};

} // namespace physvib
