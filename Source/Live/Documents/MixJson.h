// SPDX-License-Identifier: MIT
// The desk of a mixer, and its parts, as parts of other files. For the .cpp files of Files.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonLines.h"
#include "Live/Documents/Mix.h"

namespace physvib {

/// Everything but scene and seed, which are those of the session's last take. Throws JsonError.
Mix readMix(const JsonField& json);
OrderedJson mixJson(const Mix& mix);

/// Where strips leave: by outputs that each names, or by the channel of their own number.
enum class Outputs { chosen, inOrder };

/// As many strips as there are enchanters. Throws JsonError.
std::vector<Strip> readStrips(const JsonField& list, int enchanters, Outputs outputs);
OrderedJson stripsJson(std::span<const Strip> strips, Outputs outputs);

/// One per channel, null for those that are played as they are. Throws JsonError.
EqualisedActuators readEqualised(const JsonField& list, int channels);
OrderedJson equalisedJson(const EqualisedActuators& equalised, int channels);

FrequencyBand readBand(const JsonField& json); ///< throws JsonError
OrderedJson bandJson(const FrequencyBand& band);

} // namespace physvib
