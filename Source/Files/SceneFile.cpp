// SPDX-License-Identifier: MIT
// The outer shape of a scene file; its fields are read and written after the table in SceneFields.h.
#include "Files/SceneFile.h"
#include "Files/Disk/FileLimits.h"
#include "Files/Json/JsonReader.h"
#include "Files/Json/JsonText.h"
#include "Files/Json/JsonVariables.h"
#include "Files/Json/JsonVersion.h"
#include "Files/Json/JsonWriter.h"
#include "Physics/Scenes/SceneValidation.h"

namespace physvib {
namespace {

constexpr const char* sceneVersionField = "physvib_scene";

Scene readSceneRoot(Json& root, const SceneSettings& settings) {
    checkVersion(JsonField(root, {}), sceneVersionField, sceneFormatVersion);
    root.erase(sceneVersionField);
    auto variables = applyVariables(root, settings);
    Scene scene = readFields<Scene>(JsonField(root, {}));
    if (const std::string fault = validate(scene); !fault.empty()) throw JsonError({}, fault);
    scene.variables = std::move(variables);
    return scene;
}

} // namespace

Result<Scene> readScene(std::string_view text, std::string_view name, const SceneSettings& settings) {
    return readJson(text, name, limits::maxSceneFileBytes, [&](Json& root) { return readSceneRoot(root, settings); });
}

std::string sceneJson(const Scene& scene) {
    OrderedJson root = {{sceneVersionField, sceneFormatVersion}};
    root.update(detail::fieldsJson(scene, scene.materials));
    return jsonLines(root);
}

} // namespace physvib
