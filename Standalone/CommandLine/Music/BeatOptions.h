// SPDX-License-Identifier: GPL-3.0-or-later
// How beats of music are felt, as words of a call: of `beats`, and of `play --beats`.
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
    /// letters; not given: the usual ones
    std::array<std::optional<std::string>, beatBands.size()> enchanters;
    double sensitivity = BeatDetector::usualSensitivity;
    double level = BeatVoices::usualLevel;
    std::string frequencies = "205"; ///< Hz: one for all bands, or one each
};

void declareBeatOptions(OptionTable& command, BeatOptions& options);

/// On so many enchanters; or the usage error in one line.
Result<BeatVoices> beatVoicesOf(const BeatOptions& options, int enchanters);

} // namespace physvib
