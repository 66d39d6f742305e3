// SPDX-License-Identifier: MIT
// Scenes as JSON, read strictly and written back unchanged.
#pragma once
#include "Io/Result.h"
#include "Scene/Scene.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

/// The version of the format that is written, and the newest that is read.
constexpr int sceneFormatVersion = 2; // 2: change, join, unjoin; slider, slack; restitution of a fixture

/// Choices for a scene's variables, {"height", "2"}; a variable without one has its default.
using SceneSettings = std::vector<std::pair<std::string, std::string>>;

/// The scene in `text`, valid for a Simulation; or, for the first error, one line `name:
/// bodies[3].fixtures[0].radius_m: expected 0.01 to 100, found 0`. Fields: scene.schema.json. Unknown and
/// repeated fields are errors, as are settings that the scene does not have. Any thread.
Result<Scene> readScene(std::string_view text, std::string_view name, const SceneSettings& settings = {});

/// The same for a file. Message thread (M) only.
Result<Scene> loadScene(const std::filesystem::path& path, const SceneSettings& settings = {});

/// A valid scene as JSON with its present settings; readScene restores everything except the variables, bit
/// for bit. Any thread.
std::string sceneJson(const Scene& scene);

} // namespace physvib
