// SPDX-License-Identifier: MIT
// Live inputs that edit a scene permanently: adding, removing and changing bodies, joints and materials.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneRun.h"
#include <cstddef>
#include <span>

namespace physvib {

/// Applies the permanent changes of `action` to the description: materials of fixtures, sounds, haptic
/// sources; other actions change nothing. Finds the scene's and its live inputs' bodies by name. Any thread.
void describeEdit(Scene& scene, const Action& action);

/// True if an action changes the scene permanently and not only its motion. Any thread.
bool isLasting(const Action& action);

/// How many of them, from the first, can be judged by what they leave: those that put bodies, change some or
/// remove some, each another one, as what one of these spoils the others do not mend. Any thread.
std::size_t takenTogether(std::span<const Action> actions);

/// The same as describeEdit, of one action after the other, with bodies and joints; those that would make the
/// scene invalid change nothing. Any thread.
void editScene(Scene& scene, std::span<const Action> actions);

/// The scene of a scene run as its inputs left it, without inputs: added bodies start where they were put,
/// removed ones are absent (unless a joint holds them or the script needs them). Any thread.
Scene sceneAsLeft(const SceneRun& take);

/// The scene without scripted user input: pushes, tilts and device orientation; with a player (ScenePlayer),
/// the player's actions. Any thread.
Scene sceneForHands(Scene scene);

} // namespace physvib
