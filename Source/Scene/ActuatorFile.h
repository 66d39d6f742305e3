// SPDX-License-Identifier: MIT
// Actuator profiles as JSON files: measured properties and their source; unknown values are null.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Io/Result.h"
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The version of the format that is written, and the newest that is read.
constexpr int actuatorFormatVersion = 1;

/// Principle of the actuator.
enum class ActuatorKind {
    linear,  ///< follows the drive's waveform, coloured by a resonance (Core/Actuators/ActuatorEqualiser.h)
    rotating ///< a rotating mass: it is on or off, and its frequency depends on its speed
};

/// Properties of a type of actuator, in the units of their names; nullopt: not known.
struct ActuatorProfile {
    std::string name;
    std::string description;
    std::string source; ///< source of the figures
    ActuatorKind kind = ActuatorKind::linear;
    std::optional<double> resonanceHz, q;
    std::optional<FrequencyBand> band;     ///< band that it is specified for
    std::optional<double> driveLimitVolts; ///< largest voltage of either polarity, that of a sample of 1
    std::optional<double> riseSeconds;     ///< from 10 to 90 % of the level
    std::optional<double> fullScaleG;      ///< peak acceleration at the resonance, driven at its limit
    std::optional<double> delaySeconds;    ///< from sample to acceleration, of the whole measured set-up
    bool operator==(const ActuatorProfile&) const = default;

    /// Unknown (see Resonator::isKnown) if resonance or q is not known. Any thread.
    Resonator resonator() const noexcept {
        return resonanceHz && q ? Resonator{*resonanceHz, *q} : Resonator{};
    }
    FrequencyBand bandOrUnknown() const noexcept { return band.value_or(FrequencyBand{}); }
};

/// Why the actuator cannot be equalised, e.g. "q is not known (measure it with physvib calibrate)"; or empty.
/// Any thread.
std::string equaliserError(const ActuatorProfile& profile);

/// The profile in `text`; or, for the first error, one line `name: band_hz[1]: expected a number from ...`.
/// Every field is required, null if not known; unknown and repeated fields are errors. Any thread.
Result<ActuatorProfile> readActuator(std::string_view text, std::string_view name);

/// Reads a file, with the checks and errors of readActuator(). Message thread only.
Result<ActuatorProfile> loadActuator(const std::filesystem::path& path);

/// `profile` as JSON; readActuator restores it bit for bit. Any thread.
std::string actuatorJson(const ActuatorProfile& profile);

/// The profiles that come with PhysVib, in listing order. Built on first use; any thread.
const std::vector<ActuatorProfile>& builtInActuators();

/// A built-in profile by its name, else that of the file (NAME.json, or a path). Message thread only.
Result<ActuatorProfile> findActuator(const std::string& nameOrPath);

} // namespace physvib
