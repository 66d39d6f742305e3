// SPDX-License-Identifier: MIT
// Actuator profiles as JSON: what is known of an actuator, and from where; what is not known is null.
#pragma once
#include "Core/Actuators/Resonator.h"
#include "Io/Result.h"
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The version of the format that is written, and the newest that is read.
constexpr int actuatorFormatVersion = 1;

/// What its vibration follows.
enum class ActuatorKind {
    linear,  ///< the drive's waveform, coloured by a resonance (Core/Actuators/Resonator.h)
    rotating ///< its own speed: it can be on or off, and no frequency can be asked of it
};

/// No value: not known. SI, as the fields' names say.
struct ActuatorProfile {
    std::string name;
    std::string description;
    std::string source; ///< where the figures are from
    ActuatorKind kind = ActuatorKind::linear;
    std::optional<double> resonanceHz, q;
    std::optional<FrequencyBand> band;     ///< that it is declared to play
    std::optional<double> driveLimitVolts; ///< largest voltage, either way: what a sample of 1 is to become
    std::optional<double> riseSeconds;     ///< from 10 to 90 % of the level
    std::optional<double> fullScaleG;      ///< peak acceleration at the resonance, driven at its limit
    std::optional<double> delaySeconds;    ///< from sample to acceleration, of the whole set-up that was
                                           ///< measured
    bool operator==(const ActuatorProfile&) const = default;

    /// Not known (Resonator::isKnown) if either figure is missing. Any thread.
    Resonator resonator() const noexcept {
        return resonanceHz && q ? Resonator{*resonanceHz, *q} : Resonator{};
    }
    FrequencyBand bandOrNone() const noexcept { return band.value_or(FrequencyBand{}); }
};

/// What keeps the actuator from being equalised: "q is not known (measure it with physvib calibrate)"; empty:
/// nothing. Any thread.
std::string equaliserFault(const ActuatorProfile& profile);

/// The profile that `text` describes; or, of the first thing that is wrong, one line
/// `name: band_hz[1]: expected a number from ...`. Every field must be there, null if it is not known;
/// unknown and repeated fields are errors. Any thread.
Result<ActuatorProfile> readActuator(std::string_view text, std::string_view name);

/// The same of a file. M only.
Result<ActuatorProfile> loadActuator(const std::filesystem::path& path);

/// `profile` as JSON; readActuator gives it back bit for bit. Any thread.
std::string actuatorJson(const ActuatorProfile& profile);

/// Those that come with PhysVib, in the order of their listing. Built on first use; any thread.
const std::vector<ActuatorProfile>& builtInActuators();

/// A built-in profile by its name, else that of the file (NAME.json, or a path). M only.
Result<ActuatorProfile> findActuator(const std::string& nameOrPath);

} // namespace physvib
