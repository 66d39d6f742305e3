// SPDX-License-Identifier: MIT
// Tries whether a body of a scene is felt at usual impacts, before anybody waits for one.
#pragma once
#include "Scene/Scene.h"
#include <string>
#include <vector>

namespace physvib {

/// Why a body is not felt when it meets what the scene has, at the speed of a fall from a third of the
/// field's height: the explanation of a world that has no more than both, in names of the mixer's controls.
/// Empty: it is felt. A body that moves, alone in its scene, meets a floor of its own material; of a body
/// that is fixed nothing is said before something moves. Any thread; takes milliseconds.
std::string whyNotFelt(const Scene& scene, const BodyDescription& body);

/// The same for a ball that is drawn with this material; see startsAsSource().
std::string whyNotFelt(const Scene& scene, int material);

/// What makes the body felt in this scene: the first material that vibrates in place of those that do not,
/// and the body as a haptic source. Empty: it has both, or no material vibrates. Any thread.
std::vector<Action> feltChanges(const Scene& scene, const BodyDescription& body);

/// The scene with a sound for a material that has none: that of the built-in tables by its name, else a plain
/// one. An input cannot do this, since it could not be taken back.
Scene withSound(Scene scene, int material);

} // namespace physvib
