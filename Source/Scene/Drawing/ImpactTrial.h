// SPDX-License-Identifier: MIT
// Simulates typical impacts of a body, to explain in an editor why it would cause no vibration, and changes
// bodies and materials so that they do.
#pragma once
#include "Scene/Scene.h"
#include <string>
#include <vector>

namespace physvib {

/// Why a body causes no vibration when it hits the scene's other bodies at the speed of a fall from a third
/// of the field's height; the text uses the names of the mixer's controls. Empty: it vibrates, or it is fixed
/// and nothing else moves. A moving body that is alone hits a floor of its own material. Any thread.
std::string silentBodyReason(const Scene& scene, const BodyDescription& body);

/// Why a new ball of this material (an index) causes none; startsAsSource() tells if it is a source.
std::string silentBodyReason(const Scene& scene, int material);

/// Actions after which the body causes vibrations: the first material that vibrates replaces those that do
/// not, and the body becomes a haptic source. Empty: nothing to change, or no material vibrates. Any thread.
std::vector<Action> actionsToVibrate(const Scene& scene, const BodyDescription& body);

/// The scene with a sound for material `material`, which has none: the sound of its name in the built-in
/// tables, else a default. Not an action, because it could not be undone. Any thread.
Scene sceneWithSound(Scene scene, int material);

} // namespace physvib
