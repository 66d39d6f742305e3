// SPDX-License-Identifier: MIT
// Live inputs that edit a scene permanently: adding, removing and changing bodies, joints and materials.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneRun.h"

namespace physvib {

/// Applies the permanent changes of `action` to the description: materials of fixtures, sounds, haptic
/// sources; other actions change nothing. Finds bodies of the scene and of its live inputs by name. Any
/// thread.
void describeEdit(Scene& scene, const Action& action);

/// True if an action changes the scene permanently and not only its motion. Any thread.
bool isLasting(const Action& action);

/// The same, with bodies and joints; false, and nothing is changed, if there is no change or the scene would
/// be invalid. Any thread.
bool editScene(Scene& scene, const Action& action);

/// The scene of a scene run as its inputs left it, without inputs: added bodies start where they were put,
/// removed ones are absent (unless a joint holds them or the script needs them). Any thread.
Scene sceneAsLeft(const SceneRun& take);

/// The scene without scripted user input: pushes, tilts and device orientation; with a player (ScenePlayer),
/// the player's actions. Any thread.
Scene sceneForHands(Scene scene);

} // namespace physvib
