// SPDX-License-Identifier: MIT
// Live inputs that edit a scene rather than play in it: bodies that come, go and change, sounds of materials.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneTake.h"

namespace physvib {

/// The description with what `action` changes of it for good: materials of fixtures, sounds, cameras; others
/// change nothing. Bodies of the scene and of its live inputs are found by name. Any thread.
void describeEdit(Scene& scene, const Action& action);

/// Whether an action changes a scene for good, as an editor does, and not only its motion. Any thread.
bool isLasting(const Action& action);

/// The scene with what `action` changes of it for good, bodies and joints as well; false, and nothing is
/// changed, if that is nothing or would leave a scene that is not valid. Any thread.
bool editScene(Scene& scene, const Action& action);

/// The take's scene as its inputs left it, without inputs: what was added starts where it was put, what was
/// removed is not there (unless a joint holds it or the script needs it). Any thread.
Scene sceneAsLeft(const SceneTake& take);

/// The scene without what its script does of what hands do: pushes, tilts, and the way the device is held;
/// where there is a player (ScenePlayer), what that does. Any thread.
Scene sceneForHands(Scene scene);

} // namespace physvib
