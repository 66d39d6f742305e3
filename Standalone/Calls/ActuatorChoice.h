// SPDX-License-Identifier: GPL-3.0-or-later
// What --actuator, --equalise and --remap mean for a layout.
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

/// What is wanted of the actuators of a layout.
struct ActuatorChoice {
    EqualisedActuators equalised{}; ///< per enchanter
    /// from a sample to the interface's full scale; 0: not wanted
    std::array<double, limits::maxEnchanters> voltageScale{};
    FrequencyRemap remap; ///< one for all: an event has one frequency
};

/// By the options: --actuator none, a profile for all enchanters, or `layout`: those that it names. One line
/// if a profile is unknown or lacks what is wanted of it. M only.
Result<ActuatorChoice> chooseActuators(const RenderJob& options, const LayoutDescription& layout);

/// The layout with the full scale that `--actuator PROFILE` was measured to have, so that every g that
/// follows is the actuator's own. A profile that does not know it, and `--actuator layout`, leave the
/// layout's. One line if the profile is unknown, or a layout cannot have its figure. M only.
Result<LayoutDescription> calibratedLayout(const RenderJob& options, LayoutDescription layout);

/// Lines for people on actuators that a layout names, but whose measured full scale it does not have
/// (`--actuator layout`). M only.
std::vector<std::string> calibrationWarnings(const RenderJob& options, const LayoutDescription& layout);

/// Lines for people on what the choice costs: the highest level that is flat in the band, per distinct
/// actuator.
std::vector<std::string> levelNotes(const ActuatorChoice& choice, int sampleRateHz);

/// Lines for people on what remapping loses: materials that end nearer to each other than one JND, and those
/// that the actuator's own ring-down outlasts. `before`: the collisions, not remapped yet.
std::vector<std::string> remapWarnings(const FrequencyRemap& remap, std::span<const CollisionEvent> before,
                                       const LayoutDescription& layout, const RenderJob& options);

} // namespace physvib
