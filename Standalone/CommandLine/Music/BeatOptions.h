// SPDX-License-Identifier: GPL-3.0-or-later
// Options for the rendering of beats, shared by `beats` and `play --beats`.
#pragma once
#include "Host/Music/BeatDetector.h"
#include "Io/Result.h"
#include "Io/Text/NumberText.h"
#include "Options/OptionTable.h"
#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace physvib {

struct BeatOptions {
    /// Actuator letters per band; unset: default.
    std::array<std::optional<std::string>, beatBands.size()> actuators;
    double sensitivity = BeatDetector::defaultSensitivity;
    double level = BeatVoices::defaultLevel;
    std::string frequencies = "205"; ///< Hz: one for all bands, or one per band
};

inline void declareBeatOptions(OptionTable& command, BeatOptions& o) {
    for (std::size_t band = 0; band < beatBands.size(); ++band) {
        const BeatBand& b = beatBands[band];
        command
            .add("--" + std::string{b.name}, o.actuators[band],
                 "actuators that feel beats of " + numberText(b.lowHz) + " to " + numberText(b.highHz) +
                     " Hz; none: \"\"")
            .as("AB")
            .inGroup("Beats");
    }
    command
        .add("--sensitivity", o.sensitivity, "to beats: 0 for the strongest alone, to 1 for all that stirs")
        .in(0.0, 1.0)
        .inGroup("Beats");
    command.add("--strike-level", o.level, "of the strongest beats, in shares of full scale")
        .in(0.0, 1.0)
        .inGroup("Beats");
    command
        .add("--strike-hz", o.frequencies, "of the strikes: one frequency, or one each for low, mid and high")
        .as("HZ[,HZ,HZ]")
        .inGroup("Beats");
}

/// Voices for that number of actuators; or a usage error in one line.
inline Result<BeatVoices> parseBeatVoices(const BeatOptions& o, int actuatorCount) {
    BeatVoices voices;
    voices.level = o.level;
    voices.actuators = defaultBeatActuators(actuatorCount);
    for (std::size_t band = 0; band < beatBands.size(); ++band)
        if (o.actuators[band] &&
            !parseActuatorLetters(*o.actuators[band], actuatorCount, voices.actuators[band]))
            return Failure{"--" + std::string{beatBands[band].name} + ": expected letters of the " +
                           std::to_string(actuatorCount) + " actuators, each once, like A, found " +
                           inQuotes(*o.actuators[band])};
    std::vector<double> hz;
    if (parseNumbers(o.frequencies, hz) && hz.size() == 1) hz.resize(beatBands.size(), hz[0]);
    const auto isFrequency = [](double f) { return f >= 1.0 && f <= limits::maxFrequencyHz; };
    if (hz.size() != beatBands.size() || !std::ranges::all_of(hz, isFrequency))
        return Failure{"--strike-hz: expected one frequency or three, from 1 to 20000, found " +
                       inQuotes(o.frequencies)};
    std::ranges::copy(hz, voices.frequencyHz.begin());
    return voices;
}

} // namespace physvib
