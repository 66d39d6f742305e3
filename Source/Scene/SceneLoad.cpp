// SPDX-License-Identifier: MIT
// A scene from a file; what its text says is read in SceneFile.cpp, also where there are no files.
#include "Io/Disk/ReadFile.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneFileLimits.h"

namespace physvib {

Result<Scene> loadScene(const std::filesystem::path& path, const SceneSettings& settings) {
    return loadText(path, limits::maxSceneFileBytes, [&](std::string_view text, std::string_view name) {
        return readScene(text, name, settings);
    });
}

} // namespace physvib
