// SPDX-License-Identifier: MIT
// Reads and writes scene files: version and variables here, all fields by the table in SceneFields.h. Finds
// scenes by name, and detects a file's kind.
#include "Scene/SceneFile.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneJson.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneValidation.h"
#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace physvib {

namespace {

struct Choice {
    std::string value;
    const Json* replacements; // JSON Pointer to value
    std::string path;
};

struct Variable {
    SceneVariable description;
    std::vector<Choice> choices;
};

std::size_t checkSize(const JsonField& list, std::size_t max) {
    const std::size_t size = list.arraySize();
    if (size < 1 || size > max)
        list.fail("expected 1 to " + std::to_string(max) + " items, found " + std::to_string(size));
    return size;
}

Choice readChoice(const JsonField& json, const Json& value) {
    json.expectObject({"value", "set"});
    json["set"].expectObject();
    return {json["value"].text(), &value["set"], json.path() + ".set"};
}

Variable readVariable(const JsonField& json, const Json& value) {
    json.expectObject({"name", "default", "choices"});
    Variable variable{{json["name"].text(), json["default"].text(), {}}, {}};
    const JsonField list = json["choices"];
    for (std::size_t i = 0, size = checkSize(list, limits::maxChoices); i < size; ++i) {
        variable.choices.push_back(readChoice(list.item(i), value["choices"][i]));
        variable.description.choices.push_back(variable.choices.back().value);
    }
    return variable;
}

std::vector<Variable> readVariables(const JsonField& json, const Json& list) {
    std::vector<Variable> variables;
    for (std::size_t i = 0, size = checkSize(json, limits::maxVariables); i < size; ++i)
        variables.push_back(readVariable(json.item(i), list[i]));
    return variables;
}

void applySettings(std::vector<Variable>& variables, const SceneSettings& settings) {
    for (const auto& [name, value] : settings) {
        const auto hasName = [&n = name](const Variable& v) { return v.description.name == n; };
        const auto variable = std::ranges::find_if(variables, hasName);
        if (variable == variables.end()) {
            std::vector<std::string> names;
            for (const Variable& v : variables) names.push_back(v.description.name);
            throw JsonError(
                {}, "no variable " + inQuotes(name) +
                        (names.empty() ? ", the scene has none" : ", expected one of " + nameList(names)));
        }
        variable->description.value = value;
    }
}

const Choice& selectedChoice(const Variable& variable) {
    const auto& [name, value, choices] = variable.description;
    const auto found = std::ranges::find(choices, value);
    if (found == choices.end())
        throw JsonError({}, "variable " + inQuotes(name) + ": expected one of " + nameList(choices) +
                                ", found " + inQuotes(value));
    return variable.choices[static_cast<std::size_t>(found - choices.begin())];
}

Json::json_pointer checkPointer(const Json& root, const std::string& text, const std::string& path) {
    try {
        const Json::json_pointer pointer(text);
        if (!pointer.empty() && root.contains(pointer)) return pointer;
    } catch (const Json::exception&) { // the text is not a JSON pointer
    }
    throw JsonError(path, "expected a pointer to a value of the scene, found " + inQuotes(text));
}

void applyChoice(Json& root, const Choice& choice) {
    for (const auto& item : choice.replacements->items())
        root[checkPointer(root, item.key(), choice.path)] = item.value();
}

/// Removes "variables" from `root`, and applies the replacements ("set") of the chosen values:
///   [{ "name": "height", "default": "1", "choices": [{ "value": "1", "set": { POINTER: VALUE, ... } }, ...]
///   }]
/// A POINTER (JSON Pointer, RFC 6901) names a value in the file. Variables are applied in their order.
/// Returns them with the chosen values. Throws JsonError.
std::vector<SceneVariable> applyVariables(Json& root, const SceneSettings& settings) {
    const Json list = root.value("variables", Json());
    std::vector<Variable> variables;
    if (root.erase("variables") > 0) variables = readVariables(JsonField(list, "variables"), list);
    applySettings(variables, settings);
    std::vector<SceneVariable> description;
    for (const Variable& variable : variables) {
        for (const Choice& choice : variable.choices) // choices that are not set are checked, too
            for (const auto& item : choice.replacements->items()) checkPointer(root, item.key(), choice.path);
        applyChoice(root, selectedChoice(variable));
        description.push_back(variable.description);
    }
    return description;
}

constexpr const char* sceneVersionField = "physvib_scene";

Scene readSceneRoot(Json& root, const SceneSettings& settings) {
    checkVersion(JsonField(root, {}), sceneVersionField, sceneFormatVersion);
    root.erase(sceneVersionField);
    auto variables = applyVariables(root, settings);
    Scene scene = readFields<Scene>(JsonField(root, {}));
    if (const std::string error = validate(scene); !error.empty()) throw JsonError({}, error);
    scene.variables = std::move(variables);
    return scene;
}

} // namespace

Result<Scene> readScene(std::string_view text, std::string_view name, const SceneSettings& settings) {
    return readJson(text, name, limits::maxSceneFileBytes,
                    [&](Json& root) { return readSceneRoot(root, settings); });
}

std::string sceneJson(const Scene& scene) {
    OrderedJson root = {{sceneVersionField, sceneFormatVersion}};
    root.update(detail::fieldsJson(scene, scene.materials));
    return prettyJson(root);
}

Result<Scene> loadScene(const std::filesystem::path& path, const SceneSettings& settings) {
    return loadText(path, limits::maxSceneFileBytes, [&](std::string_view text, std::string_view name) {
        return readScene(text, name, settings);
    });
}

const std::vector<Scene>& builtInScenes() {
    static const std::vector<Scene> scenes = readEmbedded(
        embeddedScenes(), [](std::string_view text, std::string_view name) { return readScene(text, name); });
    return scenes;
}

const Scene* findBuiltInScene(std::string_view name) { return findNamed(builtInScenes(), name); }

Result<Scene> findScene(const std::string& nameOrPath, const SceneSettings& settings) {
    if (isJsonPath(nameOrPath)) return loadScene(nameOrPath, settings);
    for (const EmbeddedFile& file : embeddedScenes())
        if (file.name == nameOrPath + ".json") return readScene(file.text, nameOrPath, settings);
    return Failure{"no scene " + inQuotes(nameOrPath) + " (see physvib scenes)"};
}

namespace {

constexpr std::size_t headBytes = 1 << 16; // sessions may be long, but begin with the field

constexpr std::array<std::pair<std::string_view, FileKind>, 4> kindFields{
    // in this order: a plug-in's state contains a scene, a session a layout
    {{"\"physvib_plugin_state\"", FileKind::pluginState},
     {"\"physvib_session\"", FileKind::session},
     {"\"physvib_scene\"", FileKind::scene},
     {"\"extent_m\"", FileKind::layout}}};

} // namespace

FileKind fileKind(const std::filesystem::path& path) {
    std::string head(headBytes, '\0');
    if (const auto file = openRegularFile(path, std::numeric_limits<std::size_t>::max()))
        head.resize(std::fread(head.data(), 1, head.size(), file.value.stream.get()));
    for (const auto& [field, kind] : kindFields)
        if (head.find(field) != std::string::npos) return kind;
    return FileKind::unknown;
}

} // namespace physvib
