// SPDX-License-Identifier: MIT
// JSON form of the mixer state and its parts, for other files that contain them. Included by .cpp files only.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Live/Documents/Mix.h"
#include "Scene/LayoutJson.h"

namespace physvib {

/// All fields except scene and seed. Throws JsonError, as do all readers here.
Mix readMix(const JsonField& json);

std::vector<Strip> readKind(const JsonField& list, const PerChannel<std::vector<Strip>>& kind);
OrderedJson writeKind(const PerChannel<std::vector<Strip>>& kind, const std::vector<Strip>& strips);
std::vector<Strip> readKind(const JsonField& list, const kinds::PluginStrips& kind);
OrderedJson writeKind(const kinds::PluginStrips& kind, const std::vector<Strip>& strips);
GainLane readKind(const JsonField& list, const Own<GainLane>& kind);
OrderedJson writeKind(const Own<GainLane>& kind, const GainLane& lane);
FrequencyBand readKind(const JsonField& json, const Own<FrequencyBand>& kind);
OrderedJson writeKind(const Own<FrequencyBand>& kind, const FrequencyBand& band);
EqualisedActuators readKind(const JsonField& list, const PerChannel<EqualisedActuators>& kind);
OrderedJson writeKind(const PerChannel<EqualisedActuators>& kind, const EqualisedActuators& equalised);

} // namespace physvib
