// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates --actuator, --equalise and --remap for a layout.
#pragma once
#include "Calls/RenderOptions.h"
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Core/CollisionEvent.h"
#include "Core/EventShaping.h"
#include "Scene/LayoutFile.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// Processing of the output for the actuators of a layout.
struct ActuatorChoice {
    EqualisedActuators equalised{}; ///< one per actuator
    /// From a sample to the interface's full scale; 0: no scaling.
    std::array<double, limits::maxEnchanters> voltageScale{};
    FrequencyRemap remap; ///< one for all actuators, because an event has one frequency
};

/// From the options: --actuator none, one profile for all actuators, or `layout` for the profiles in the
/// layout. One error line if a profile is unknown or lacks required data. Message thread only.
Result<ActuatorChoice> chooseActuators(const RenderJob& options, const LayoutDescription& layout);

/// Layout with the measured full scale of `--actuator PROFILE`, so that all values in g refer to that
/// actuator. With `--actuator layout`, or a profile without a full scale, the layout's values stay. One error
/// line if the profile is unknown or a layout cannot store the value. Message thread only.
Result<LayoutDescription> calibratedLayout(const RenderJob& options, LayoutDescription layout);

/// Warnings on actuators of the layout whose measured full scale the layout does not contain (`--actuator
/// layout`). Message thread only.
std::vector<std::string> calibrationWarnings(const RenderJob& options, const LayoutDescription& layout);

/// Notes on the cost of equalisation: the maximum level with a flat response in the band, per distinct
/// actuator.
std::vector<std::string> levelNotes(const ActuatorChoice& choice, int sampleRateHz);

/// Warnings on remapping: materials that end up less than one JND apart, and materials that decay faster than
/// the actuator itself. `before`: the collisions before remapping.
std::vector<std::string> remapWarnings(const FrequencyRemap& remap, std::span<const CollisionEvent> before,
                                       const LayoutDescription& layout, const RenderJob& options);

} // namespace physvib
