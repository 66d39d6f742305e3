// SPDX-License-Identifier: MIT
// Reads the embedded scenes like scene files.
#include "Io/Text/NumberText.h"
#include "Scene/SceneFile.h"
#include <algorithm>

namespace physvib {

const std::vector<Scene>& builtInScenes() {
    static const std::vector<Scene> scenes = readEmbedded(
        embeddedScenes(), [](std::string_view text, std::string_view name) { return readScene(text, name); });
    return scenes;
}

const Scene* findBuiltInScene(std::string_view name) {
    const auto& scenes = builtInScenes();
    const auto found = std::ranges::find_if(scenes, [&](const Scene& s) { return s.name == name; });
    return found == scenes.end() ? nullptr : &*found;
}

Result<Scene> findScene(const std::string& nameOrPath, const SceneSettings& settings) {
    if (isJsonPath(nameOrPath)) return loadScene(nameOrPath, settings);
    for (const EmbeddedFile& file : embeddedScenes())
        if (file.name == nameOrPath + ".json") return readScene(file.text, nameOrPath, settings);
    return Failure{"no scene " + inQuotes(nameOrPath) + " (see physvib scenes)"};
}

} // namespace physvib
