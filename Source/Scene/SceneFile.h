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
constexpr int sceneFormatVersion = 2; // 2: change, join, unjoin; slider, slack, rest; a fixture's restitution

/// Chosen values of a scene's variables, {"height", "2"}; others have their defaults.
using SceneSettings = std::vector<std::pair<std::string, std::string>>;

/// The scene in `text`, valid for a Simulation; or, for the first error, one line `name:
/// bodies[3].fixtures[0].radius_m: expected 0.01 to 100, found 0`. Fields: scene.schema.json. Unknown and
/// repeated fields are errors, as are settings that the scene does not have. Any thread.
Result<Scene> readScene(std::string_view text, std::string_view name, const SceneSettings& settings = {});

/// Reads a file, with the checks and errors of readScene(). Message thread only.
Result<Scene> loadScene(const std::filesystem::path& path, const SceneSettings& settings = {});

/// A valid scene as JSON with its present settings; readScene restores everything except the variables, bit
/// for bit. Any thread.
std::string sceneJson(const Scene& scene);

/// Source/Scene/Scenes/*.json, in the order of their listing. Any thread.
const std::vector<EmbeddedFile>& embeddedScenes();

/// All built-in scenes with the defaults of their variables, in listing order. Built on first use; any
/// thread.
const std::vector<Scene>& builtInScenes();

/// The built-in scene of that name, with its defaults; nullptr if there is none. Any thread.
const Scene* findBuiltInScene(std::string_view name);

/// A built-in scene by its name, else the scene of the file. Message thread only.
Result<Scene> findScene(const std::string& nameOrPath, const SceneSettings& settings = {});

enum class FileKind { unknown, session, scene, layout, pluginState };

/// The kind of a file by a field that all files of the kind have, even of invalid ones; unknown if
/// unreadable. Message thread.
FileKind fileKind(const std::filesystem::path& path);

} // namespace physvib
