// SPDX-License-Identifier: MIT
// File that a page opens: a scene, an event list or a clip, selected by its name.
#pragma once
#include "Core/CollisionEvent.h"
#include "Io/Result.h"
#include "Scene/SceneFile.h"
#include <string_view>
#include <vector>

namespace physvib {

/// A world and the events played in it: none for a scene, its events for a list, and one event that stands
/// for the samples of a clip.
struct PageFile {

    Scene scene;
    std::vector<CollisionEvent> strikes; ///< sorted by time
    std::vector<float> samples;          ///< at the renderer's rate
};

/// `name` ends in .csv, .haptic or .ahap; otherwise it is a scene. A list without a field gets one of the
/// given size, m. A clip plays in the centre of all actuators, as in `physvib render`.
Result<PageFile> readPageFile(std::string_view name, std::string_view text, const SceneSettings& settings,
                              Vector fieldMetres, int sampleRateHz);

} // namespace physvib
