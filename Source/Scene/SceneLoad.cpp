// SPDX-License-Identifier: MIT
// Loads a scene from a file; SceneFile.cpp parses the text, also in builds without file access.
#include "Io/Disk/ReadFile.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneLimits.h"

namespace physvib {

Result<Scene> loadScene(const std::filesystem::path& path, const SceneSettings& settings) {
    return loadText(path, limits::maxSceneFileBytes, [&](std::string_view text, std::string_view name) {
        return readScene(text, name, settings);
    });
}

} // namespace physvib
