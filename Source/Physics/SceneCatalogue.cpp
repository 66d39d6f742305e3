// SPDX-License-Identifier: MIT
// The list of built-in scenes.
#include "Physics/SceneCatalogue.h"
#include "Physics/ShakeTheBox.h"
#include <algorithm>

namespace physvib {

const std::vector<Scene>& builtInScenes() {
    static const std::vector<Scene> scenes{shakeTheBox()};
    return scenes;
}

const Scene* findBuiltInScene(std::string_view name) {
    const auto& scenes = builtInScenes();
    const auto found =
        std::find_if(scenes.begin(), scenes.end(), [&](const Scene& s) { return s.name == name; });
    return found == scenes.end() ? nullptr : &*found;
}

} // namespace physvib
