// SPDX-License-Identifier: GPL-3.0-or-later
// Options for the rendering of beats, shared by `beats` and `play --beats`.
#pragma once
#include "Host/Music/BeatDetector.h"
#include "Host/Music/BeatStrikes.h"
#include "Io/Result.h"
#include <array>
#include <optional>
#include <string>

namespace physvib {

class OptionTable;

struct BeatOptions {
    /// Actuator letters per band; unset: default.
    std::array<std::optional<std::string>, beatBands.size()> enchanters;
    double sensitivity = BeatDetector::usualSensitivity;
    double level = BeatVoices::usualLevel;
    std::string frequencies = "205"; ///< Hz: one for all bands, or one per band
};

void declareBeatOptions(OptionTable& command, BeatOptions& options);

/// Voices for that number of actuators; or a usage error in one line.
Result<BeatVoices> beatVoicesOf(const BeatOptions& options, int enchanters);

} // namespace physvib
