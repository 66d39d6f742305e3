// SPDX-License-Identifier: MIT
// The built-in scenes, and a lookup by name or file.
#pragma once
#include "Io/Disk/Embedded.h"
#include "Scene/SceneFile.h"
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Source/Scene/Scenes/*.json, in the order of their listing. Any thread.
const std::vector<EmbeddedFile>& embeddedScenes();

/// All built-in scenes, with their variables' defaults, in the order of their listing. Built on first use;
/// any thread.
const std::vector<Scene>& builtInScenes();

/// The built-in scene of that name, with its defaults; nullptr if there is none. Any thread.
const Scene* findBuiltInScene(std::string_view name);

/// A built-in scene by its name, else the scene of the file. M only.
Result<Scene> findScene(const std::string& nameOrPath, const SceneSettings& settings = {});

} // namespace physvib
