// SPDX-License-Identifier: MIT
// Scenes as JSON, read strictly and written back unchanged; the built-in scenes; and the kind of a file.
#pragma once
#include "Io/Disk/Embedded.h"
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

// The built-in scenes, and a lookup by name or file.

/// Source/Scene/Scenes/*.json, in the order of their listing. Any thread.
const std::vector<EmbeddedFile>& embeddedScenes();

/// All built-in scenes, with their variables' defaults, as they are listed. Built on first use; any thread.
const std::vector<Scene>& builtInScenes();

/// The built-in scene of that name, with its defaults; nullptr if there is none. Any thread.
const Scene* findBuiltInScene(std::string_view name);

/// A built-in scene by its name, else the scene of the file. M only.
Result<Scene> findScene(const std::string& nameOrPath, const SceneSettings& settings = {});

enum class FileKind { unknown, session, scene, layout, pluginState };

/// By a field that every file of its kind has; the file may still be invalid. Unknown also if it cannot be
/// read. Message thread (M) only.
FileKind fileKind(const std::filesystem::path& path);

} // namespace physvib
