// SPDX-License-Identifier: MIT
// What a page is given: a scene, an event list or a clip, by its name.
#pragma once
#include "Core/CollisionEvent.h"
#include "Io/Result.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneFile.h"
#include <string_view>
#include <vector>

namespace physvib {

/// A world, and what is played beside it: of a scene nothing, of a list its strikes, of a clip one that
/// stands for its samples.
struct PageFile {

    Scene scene;
    std::vector<CollisionEvent> strikes; ///< in the order of their times
    std::vector<float> samples;          ///< at the renderer's rate
};

/// `name` ends in .csv, .haptic or .ahap, or it is a scene. A list that says no field is felt on one of that
/// size, m, a clip in the middle of all actuators, as `physvib render` has it.
Result<PageFile> readPageFile(std::string_view name, std::string_view text, const SceneSettings& settings,
                              Vector fieldMetres, int sampleRateHz);

} // namespace physvib
