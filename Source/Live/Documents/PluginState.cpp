// SPDX-License-Identifier: MIT
// The plug-in's state: its own fields, and within them a scene and a layout as their own files have them.
#include "Live/Documents/PluginState.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonLines.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/MixJson.h"
#include "Scene/SceneFile.h"
#include "Scene/SceneFileLimits.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace physvib {
namespace {

constexpr const char* stateVersionField = "physvib_plugin_state";
constexpr std::array<std::string_view, 2> transportNames{"free", "restart-on-play"}; // as TransportMode
constexpr int mostEditorPixels = 20'000;
constexpr std::size_t mostNotes = 128, mostControllers = 120, mostParameters = 1000;

int wholeNumberUpTo(const JsonField& field, int most) {
    const int found = field.wholeNumber();
    if (found < 0 || found > most)
        field.fail("expected 0 to " + std::to_string(most) + ", found " + std::to_string(found));
    return found;
}

std::size_t sizeUpTo(const JsonField& list, std::size_t most) {
    const std::size_t size = list.arraySize();
    if (size > most)
        list.fail("expected at most " + std::to_string(most) + " items, found " + std::to_string(size));
    return size;
}

/// A part that has a reader of its own: its message begins with the part's name instead of a file's.
template <class Part, class Read>
Part readPart(const Json& root, const char* field, Read read) {
    if (!root.contains(field)) throw JsonError({}, "field " + inQuotes(field) + " is missing");
    const Result<Part> part = read(root[field].dump(-1, ' ', false, Json::error_handler_t::replace), field);
    if (!part) throw JsonError({}, part.error);
    return part.value;
}

std::uint32_t readSeed(const JsonField& field) {
    const double found = field.numberUpTo(4294967295.0);
    if (found != std::floor(found)) field.fail("expected a whole number, found " + numberText(found));
    return static_cast<std::uint32_t>(found);
}

int readSteps(const JsonField& field) {
    const int found = field.wholeNumber();
    if (found < Simulation::minStepsPerSecond || found > Simulation::maxStepsPerSecond)
        field.fail("expected " + std::to_string(Simulation::minStepsPerSecond) + " to " +
                   std::to_string(Simulation::maxStepsPerSecond) + ", found " + std::to_string(found));
    return found;
}

int readMaterial(const JsonField& field, const Scene& scene) {
    const std::string wanted = field.text();
    const auto found = std::ranges::find(scene.materials, wanted, &Material::name);
    if (found == scene.materials.end())
        field.fail("expected the name of a material of the scene, found " + inQuotes(wanted));
    return static_cast<int>(found - scene.materials.begin());
}

std::string readObject(const JsonField& field, const Scene& scene) {
    const std::string wanted = field.text();
    if (std::ranges::find(scene.bodies, wanted, &BodyDescription::name) == scene.bodies.end())
        field.fail("expected the name of a body that the scene starts with, found " + inQuotes(wanted));
    return wanted;
}

Vector readVector(const JsonField& field, double reach) {
    if (const std::size_t size = field.arraySize(); size != 2)
        field.fail("expected 2 numbers, found " + std::to_string(size) + " items");
    const Vector v{field.item(0).number(), field.item(1).number()};
    if (!(std::abs(v.x) <= reach && std::abs(v.y) <= reach))
        field.fail("expected up to " + numberText(reach));
    return v;
}

NoteRule readNote(const JsonField& field, const Scene& scene) {
    field.expectObject();
    NoteRule rule;
    rule.note = wholeNumberUpTo(field["note"], 127);
    rule.kind = static_cast<NoteKind>(field["do"].oneOf(noteKindNames));
    if (rule.kind == NoteKind::push) {
        field.expectObject({"note", "do", "object", "impulse_ns"});
        rule.object = readObject(field["object"], scene);
        rule.atFullVelocity = readVector(field["impulse_ns"], sceneLimits::maxImpulseNewtonSeconds);
        return rule;
    }
    rule.material = readMaterial(field["material"], scene);
    rule.x = field["x"].numberUpTo(1.0);
    rule.y = field["y"].numberUpTo(1.0);
    if (rule.kind == NoteKind::strike) {
        field.expectObject({"note", "do", "material", "x", "y"});
        return rule;
    }
    field.expectObject({"note", "do", "material", "x", "y", "radius_m", "velocity_m_per_s"});
    rule.radiusMetres = field["radius_m"].numberUpTo(sceneLimits::maxSizeMetres);
    if (rule.radiusMetres < sceneLimits::minSizeMetres)
        field["radius_m"].fail("expected at least " + numberText(sceneLimits::minSizeMetres));
    rule.atFullVelocity = readVector(field["velocity_m_per_s"], sceneLimits::maxSpeedMetresPerSecond);
    return rule;
}

ControllerRule readController(const JsonField& field) {
    field.expectObject({"controller", "parameter"});
    return {wholeNumberUpTo(field["controller"], 119), field["parameter"].text()};
}

double numberFrom(const JsonField& field, double least, double most) {
    const double found = field.number();
    if (!(found >= least && found <= most))
        field.fail("expected " + numberText(least) + " to " + numberText(most) + ", found " +
                   numberText(found));
    return found;
}

NoteVoice readVoice(const JsonField& field) {
    using Limits = NoteVoiceLimits;
    field.expectObject({"pitch", "places", "held", "loudest", "decay_per_s", "release_s", "velocity_exponent",
                        "bend_semitones"});
    NoteVoice voice;
    voice.pitch = static_cast<NotePitch>(field["pitch"].oneOf(notePitchNames));
    voice.places = static_cast<NotePlaces>(field["places"].oneOf(notePlaceNames));
    voice.isHeld = field["held"].truth();
    voice.isLoudest = field["loudest"].truth();
    voice.decayPerSecond =
        numberFrom(field["decay_per_s"], Limits::leastDecayPerSecond, Limits::mostDecayPerSecond);
    voice.releaseSeconds =
        numberFrom(field["release_s"], Limits::leastReleaseSeconds, Limits::mostReleaseSeconds);
    voice.velocityExponent =
        numberFrom(field["velocity_exponent"], Limits::leastExponent, Limits::mostExponent);
    voice.bendSemitones = numberFrom(field["bend_semitones"], 0.0, Limits::mostSemitones);
    return voice;
}

OrderedJson voiceJson(const NoteVoice& voice) {
    return {{"pitch", std::string(notePitchNames[static_cast<std::size_t>(voice.pitch)])},
            {"places", std::string(notePlaceNames[static_cast<std::size_t>(voice.places)])},
            {"held", voice.isHeld},
            {"loudest", voice.isLoudest},
            {"decay_per_s", voice.decayPerSecond},
            {"release_s", voice.releaseSeconds},
            {"velocity_exponent", voice.velocityExponent},
            {"bend_semitones", voice.bendSemitones}};
}

// What moves hands does not come unasked: nobody had chosen these.
const std::vector<ControllerRule> controllersOfVersion1{
    {1, "tilt"}, {7, "level"}, {16, "gravity"}, {17, "exponent"}};

ParameterValue readParameter(const Json& value, const JsonField& field) {
    if (value.is_string()) return field.text();
    return field.number();
}

PluginState readStateRoot(const Json& json) {
    const JsonField root{json, {}};
    checkVersion(root, stateVersionField, pluginStateVersion);
    root.expectObject({stateVersionField, "scene", "seed", "steps_per_second", "layout", "strips",
                       "equalised", "limiter", "transport", "direct", "voice", "notes", "controllers",
                       "editor_px", "parameters"});
    PluginState state;
    state.scene = readPart<Scene>(
        json, "scene", [](const std::string& text, const char* name) { return readScene(text, name); });
    state.layout = readPart<LayoutDescription>(json, "layout", readLayout);
    const int enchanters = state.layout.geometry.count;
    if (root.has("strips"))
        state.strips = readStrips(root["strips"], enchanters, Outputs::inOrder);
    else
        resizeStrips(state.strips, enchanters); // version 1
    if (root.has("equalised")) state.equalised = readEqualised(root["equalised"], enchanters);
    state.seed = readSeed(root["seed"]);
    state.stepsPerSecond = readSteps(root["steps_per_second"]);
    state.limiterEnabled = root["limiter"].truth();
    state.transport = static_cast<TransportMode>(root["transport"].oneOf(transportNames));
    state.isDirect = root.has("direct") && root["direct"].truth();
    if (root.has("voice")) state.voice = readVoice(root["voice"]);
    const JsonField notes = root["notes"], controllers = root["controllers"], parameters = root["parameters"];
    for (std::size_t i = 0, n = sizeUpTo(notes, mostNotes); i < n; ++i)
        state.notes.push_back(readNote(notes.item(i), state.scene));
    for (std::size_t i = 0, n = sizeUpTo(controllers, mostControllers); i < n; ++i)
        state.controllers.push_back(readController(controllers.item(i)));
    if (root[stateVersionField].wholeNumber() == 1 && state.controllers == controllersOfVersion1)
        state.controllers.clear();
    if (root.has("editor_px")) {
        const Vector size = readVector(root["editor_px"], mostEditorPixels);
        state.editorWidth = static_cast<int>(size.x), state.editorHeight = static_cast<int>(size.y);
    }
    parameters.expectObject();
    if (json["parameters"].size() > mostParameters)
        parameters.fail("expected at most " + std::to_string(mostParameters) + " parameters");
    for (const auto& item : json["parameters"].items())
        state.parameters.emplace_back(item.key(), readParameter(item.value(), parameters[item.key()]));
    return state;
}

OrderedJson noteJson(const NoteRule& rule, const Scene& scene) {
    OrderedJson json = {{"note", rule.note},
                        {"do", std::string(noteKindNames[static_cast<std::size_t>(rule.kind)])}};
    const OrderedJson vector = OrderedJson::array({rule.atFullVelocity.x, rule.atFullVelocity.y});
    if (rule.kind == NoteKind::push) {
        json["object"] = rule.object;
        json["impulse_ns"] = vector;
        return json;
    }
    json["material"] = scene.materials[static_cast<std::size_t>(rule.material)].name;
    json["x"] = rule.x;
    json["y"] = rule.y;
    if (rule.kind == NoteKind::strike) return json;
    json["radius_m"] = rule.radiusMetres;
    json["velocity_m_per_s"] = vector;
    return json;
}

} // namespace

Result<PluginState> readPluginState(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxSceneFileBytes, readStateRoot);
}

std::string pluginStateJson(const PluginState& state) {
    OrderedJson root = {{stateVersionField, pluginStateVersion}};
    root["scene"] = OrderedJson::parse(sceneJson(state.scene));
    root["seed"] = state.seed;
    root["steps_per_second"] = state.stepsPerSecond;
    root["layout"] = OrderedJson::parse(layoutJson(state.layout));
    auto strips = state.strips;
    resizeStrips(strips, state.layout.geometry.count);
    root["strips"] = stripsJson(strips, Outputs::inOrder);
    root["equalised"] = equalisedJson(state.equalised, state.layout.geometry.count);
    root["limiter"] = state.limiterEnabled;
    root["transport"] = std::string(transportNames[static_cast<std::size_t>(state.transport)]);
    root["direct"] = state.isDirect;
    root["voice"] = voiceJson(state.voice);
    root["notes"] = OrderedJson::array();
    for (const NoteRule& rule : state.notes) root["notes"].push_back(noteJson(rule, state.scene));
    root["controllers"] = OrderedJson::array();
    for (const ControllerRule& rule : state.controllers)
        root["controllers"].push_back({{"controller", rule.controller}, {"parameter", rule.parameter}});
    if (state.editorWidth > 0) root["editor_px"] = {state.editorWidth, state.editorHeight};
    root["parameters"] = OrderedJson::object();
    for (const auto& [id, value] : state.parameters)
        std::visit([&json = root["parameters"][id]](const auto& it) { json = it; }, value);
    return jsonLines(root);
}

} // namespace physvib
