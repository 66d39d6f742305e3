// SPDX-License-Identifier: MIT
// Simulates usual impacts of a body, to explain in an editor why it would cause no vibration.
#pragma once
#include "Scene/Scene.h"
#include <string>
#include <vector>

namespace physvib {

/// Why a body causes no vibration when it hits the scene's other bodies, at the speed of a fall from a third
/// of the field's height, in names of the mixer's controls. Empty: it vibrates, or it is fixed and nothing
/// else moves. A moving body that is alone in its scene hits a floor of its own material. Any thread; takes
/// milliseconds.
std::string whyNotFelt(const Scene& scene, const BodyDescription& body);

/// The same for a ball that is drawn with this material; see startsAsSource().
std::string whyNotFelt(const Scene& scene, int material);

/// Actions after which the body causes vibrations: the first material that vibrates replaces those that do
/// not, and the body becomes a haptic source. Empty: it has both, or no material vibrates. Any thread.
std::vector<Action> feltChanges(const Scene& scene, const BodyDescription& body);

/// The scene with a sound for a material that has none: that of its name in the built-in tables, else a
/// default one. An input does not do this, because it could not be undone.
Scene withSound(Scene scene, int material);

} // namespace physvib
