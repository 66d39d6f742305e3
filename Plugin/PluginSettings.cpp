// SPDX-License-Identifier: GPL-3.0-or-later
// Settings and parameters of a plug-in state; then the built-in presets: instruments with their kits, voices
// and arrangements of actuators, and the scenes.
#include "PluginSettings.h"
#include "Io/Text/NameList.h"
#include "Parameters.h"
#include "Scene/SceneFile.h"
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

namespace physvib {

void fitToLayout(PluginState& state) {
    resizeStrips(state.strips, actuatorCount(state));
    std::fill(state.equalised.begin() + actuatorCount(state), state.equalised.end(), EqualisedActuator{});
}

void applyLayoutPreset(PluginState& state, std::string_view name) {
    state.layout = presetLayout(name, state.layout.actuators);
    fitToLayout(state);
}

void setScene(PluginState& state, Scene scene) {
    const Scene before = std::exchange(state.scene, std::move(scene));
    for (const NoteRule& rule : std::exchange(state.notes, {})) {
        NoteRule adaptedRule = rule;
        if (rule.kind == NoteKind::push) {
            if (std::ranges::find(state.scene.bodies, rule.object, &BodyDescription::name) ==
                state.scene.bodies.end())
                continue;
        } else {
            const auto& materials = state.scene.materials;
            const auto found = std::ranges::find(
                materials, before.materials[static_cast<std::size_t>(rule.material)].name, &Material::name);
            if (found == materials.end()) continue;
            adaptedRule.material = static_cast<int>(found - materials.begin());
        }
        state.notes.push_back(adaptedRule);
    }
}

bool canKeepPlaying(const PluginState& a, const PluginState& b) {
    return a.seed == b.seed && a.stepsPerSecond == b.stepsPerSecond && a.limiterEnabled == b.limiterEnabled &&
           a.transport == b.transport && a.isDirect == b.isDirect &&
           isSame(a.layout.geometry, b.layout.geometry) && a.equalised == b.equalised && a.voice == b.voice &&
           a.notes == b.notes && a.controllers == b.controllers && a.scene == b.scene;
}

PhantomPanner makePanner(const PluginState& state, PanningLaw law, double exponent) noexcept {
    return {state.layout.geometry, law, exponent, state.scene.fieldWidthMetres,
            state.scene.fieldHeightMetres};
}

SessionSetup makeSessionSetup(const PluginState& state) {
    SessionSetup setup;
    setup.scene = state.scene;
    setup.seed = state.seed;
    setup.stepsPerSecond = state.stepsPerSecond;
    setup.hasWorld = hasWorld(state);
    setup.channels = actuatorCount(state);
    setup.modes = 256; // fewer than a mixer's, because a host may have many instances
    setup.panner = makePanner(state, PanningLaw::linear, 1.0);
    setup.limiterEnabled = state.limiterEnabled;
    setup.equalised = state.equalised;
    setup.groups = actionGroups(state);
    if (state.isDirect) setup.direct = Direct::fromStart;
    setup.log = LogUse::none; // a host may play for months, and saves its own project
    return setup;
}

bool hasWorld(const PluginState& state) noexcept {
    const auto& scene = state.scene;
    return !scene.bodies.empty() || !scene.script.empty() || !scene.inputs.empty() ||
           std::ranges::any_of(state.notes,
                               [](const NoteRule& rule) { return rule.kind == NoteKind::spawn; });
}

bool isParameterUsed(const PluginState& state, const NoteKnobs& knobs, Parameter which) noexcept {
    const bool isHeld = adjustedVoice(state.voice, knobs).isHeld;
    switch (which) {
    case Parameter::gravity:
    case Parameter::tilt:
    case Parameter::timing: return hasWorld(state);
    case Parameter::material:
        return std::ranges::any_of(state.scene.bodies, [](const BodyDescription& body) {
            return std::ranges::any_of(body.fixtures, &FixtureDescription::isCamera);
        });
    case Parameter::release: return isHeld;
    case Parameter::decay:
        return !isHeld || std::ranges::any_of(state.notes, [](const NoteRule& rule) {
            return rule.kind == NoteKind::strike;
        });
    default: return true;
    }
}

double tailSeconds(const PluginState& state, const NoteKnobs& knobs) noexcept {
    if (hasWorld(state)) return std::numeric_limits<double>::infinity();
    double minDecayPerSecond = limits::maxDecayPerSecond;
    const NoteVoice voice = adjustedVoice(state.voice, knobs);
    if (voice.isHeld)
        minDecayPerSecond = std::log(1000.0) / voice.releaseSeconds;
    else if (voice.pitch == NotePitch::note)
        minDecayPerSecond = voice.decayPerSecond;
    for (const auto& m : state.scene.materials)
        if (m.frequencyHz > 0.0 && m.decayPerSecond > 0.0)
            minDecayPerSecond = std::min(minDecayPerSecond, m.decayPerSecond / knobs.decay);
    return limits::retireDecibels / 20.0 * std::log(10.0) / minDecayPerSecond;
}

ParameterValue toStateValue(const ParameterRow& row, double value) {
    if (row.choices.empty()) return value;
    return valueText(row, value);
}

std::optional<double> fromStateValue(const ParameterRow& row, const ParameterValue& value) {
    if (const auto* const number = std::get_if<double>(&value)) return *number;
    const auto& word = std::get<std::string>(value);
    if (std::ranges::find(row.choices, word) == row.choices.end()) return {};
    return valueFromText(row, word);
}

double parameterValue(const PluginState& state, Parameter which) {
    const auto& row = rowOf(which);
    const auto found =
        std::ranges::find(state.parameters, row.id, &std::pair<std::string, ParameterValue>::first);
    return found == state.parameters.end() ? row.initial
                                           : fromStateValue(row, found->second).value_or(row.initial);
}

void setParameter(PluginState& state, Parameter which, double value) {
    const auto& row = rowOf(which);
    std::erase_if(state.parameters, [&row](const auto& p) { return p.first == row.id; });
    state.parameters.emplace_back(row.id, std::clamp(value, row.minimum, row.maximum));
}

std::string parameterError(const PluginState& state) {
    const auto unknownId = [](const std::string& id) { return "no parameter \"" + id + "\""; };
    for (const auto& [id, value] : state.parameters) {
        const int which = findParameter(id);
        if (which < 0) return unknownId(id);
        if (const auto& row = rowOf(static_cast<Parameter>(which)); !fromStateValue(row, value))
            return "parameters." + id + ": expected " +
                   (row.choices.empty() ? "a number" : "one of " + nameList(row.choices)) + ", found \"" +
                   std::get<std::string>(value) + "\"";
    }
    for (const auto& rule : state.controllers)
        if (findParameter(rule.parameter) < 0) return unknownId(rule.parameter);
    return {};
}

namespace {

/// A note of a kit: its material, and its place as shares of the field, 0 to 1.
struct KitNote {
    int note;
    std::string_view material;
    double frequencyHz, decayPerSecond, x, y;
};

// General MIDI's note numbers; low drums are below, short ones above.
constexpr std::array drumKit{
    KitNote{36, "kick", 48, 14, 0.5, 0.0},         KitNote{38, "snare", 170, 34, 0.0, 0.5},
    KitNote{42, "closed hat", 320, 110, 1.0, 1.0}, KitNote{46, "open hat", 300, 16, 1.0, 0.8},
    KitNote{41, "low tom", 70, 12, 0.0, 0.0},      KitNote{45, "middle tom", 95, 14, 0.35, 0.6},
    KitNote{48, "high tom", 125, 16, 0.65, 0.6},   KitNote{49, "crash", 260, 6, 0.0, 1.0},
    KitNote{51, "ride", 280, 9, 1.0, 0.4}};
constexpr std::array clickKit{KitNote{60, "click", 250, 120, 0.5, 0.5},
                              KitNote{61, "low click", 120, 80, 0.5, 0.5}};
constexpr std::array heartKit{KitNote{60, "first beat", 42, 16, 0.4, 0.4},
                              KitNote{61, "second beat", 55, 20, 0.6, 0.6}};

/// How a preset arranges any number of actuators. Its notes have places as shares of the field, which the
/// layout's extent covers, so they suit each number.
enum class Arrangement {
    grid, ///< row by row from the upper left, as near to a square as the number allows
    row,  ///< from left to right
    belt  ///< on a circle, A in front, then clockwise as seen from above
};

struct Instrument {
    std::string_view name;
    Arrangement arrangement;
    int actuators;   ///< the number that it is made for
    double strikeDb; ///< strike level at which all are equally strong (Tests/Plugin/LoudnessTest.cpp)
    NoteVoice voice;
    std::span<const KitNote> kit{};
    double beats = 0.0; ///< per cent
};

NoteVoice struckVoice(NotePlacement places, double decayPerSecond) {
    return {
        .pitch = NotePitch::note, .placement = places, .levelsPeak = true, .decayPerSecond = decayPerSecond};
}

NoteVoice heldVoice(NotePlacement places, double releaseSeconds, double bendSemitones) {
    return {.pitch = NotePitch::note,
            .placement = places,
            .isHeld = true,
            .levelsPeak = true,
            .decayPerSecond = 10.0,
            .releaseSeconds = releaseSeconds,
            .bendSemitones = bendSemitones};
}

const std::vector<Instrument>& instruments() {
    using enum NotePlacement;
    using enum Arrangement;
    static const std::vector<Instrument> all{
        {"Keys", grid, 4, 6.0, struckVoice(octave, 12.0)},
        {"Drum kit", grid, 4, 5.0, struckVoice(octave, 20.0), drumKit},
        {"Bass", grid, 4, 2.5, struckVoice(middle, 4.0)},
        {"Strings", grid, 4, 0.0, heldVoice(octave, 0.4, 2.0)},
        {"Stereo pair", row, 2, 0.0, heldVoice(octave, 0.1, 2.0)},
        {"Four corners", grid, 4, 6.0, struckVoice(actuators, 15.0)},
        {"Belt of eight", belt, 8, 8.0, struckVoice(actuators, 25.0)},
        {"Sweep", grid, 4, 0.0, heldVoice(middle, 0.2, 24.0)},
        {"MPE pad", grid, 4, 0.0, heldVoice(octave, 0.8, 48.0)},
        {"Clicks", grid, 4, 12.0, struckVoice(middle, 120.0), clickKit},
        {"Heartbeat", grid, 4, 6.0, struckVoice(middle, 16.0), heartKit},
        {"Beats of the music", grid, 4, 6.0, struckVoice(octave, 20.0), {}, 50.0},
    };
    return all;
}

/// Factor on a scene's drive gain that makes it as strong as an instrument on that many actuators: each gets
/// less of an impact if there are more (Tests/Plugin/LoudnessTest.cpp measures it).
double driveFactorOf(std::string_view scene, int actuators) noexcept {
    struct Drive {
        std::string_view scene;
        std::array<double, 5> factors; // on 1, 2, 4, 8, 16 actuators
    };
    static constexpr std::array drives{Drive{"shake-the-box", {7.91, 8.01, 8.78, 8.48, 9.74}},
                                       Drive{"fruit-basket", {5.2, 7.6, 9.9, 10.6, 13.0}},
                                       Drive{"driving", {10.2, 11.2, 13.8, 15.5, 15.0}},
                                       Drive{"drop", {17.0, 34.0, 38.0, 48.5, 89.3}},
                                       Drive{"box-study", {46.6, 50, 58, 61.5, 66.6}},
                                       Drive{"marbles", {6.1, 6.36, 7.8, 7.65, 8.8}},
                                       Drive{"drawing", {4.2, 5.5, 6.5, 6.0, 10.2}}};
    const auto found = std::ranges::find(drives, scene, &Drive::scene);
    const int column = std::bit_width(static_cast<unsigned int>(std::clamp(actuators, 1, 16))) - 1;
    return found == drives.end() ? 8.0 : found->factors[static_cast<std::size_t>(column)];
}

/// A scene without bodies for an instrument: materials, its kit's among them, and a field to be struck.
Scene bodilessScene(const Instrument& instrument) {
    Scene scene = builtInScenes().front();
    scene.name = instrument.name;
    scene.bodies.clear();
    scene.joints.clear();
    scene.script.clear();
    scene.inputs.clear();
    scene.variables.clear();
    for (const KitNote& note : instrument.kit) {
        Material material = scene.materials.back();
        material.name = note.material;
        material.frequencyHz = note.frequencyHz;
        material.decayPerSecond = note.decayPerSecond;
        scene.materials.push_back(material);
    }
    return scene;
}

ActuatorLayout beltLayout(int count) {
    // On a circle the last and the first are neighbours: a note on one actuator is not shared among all.
    ActuatorLayout circle{2.0, 2.0, count, {}};
    for (int j = 0; j < count; ++j) {
        const double angle = 2.0 * std::numbers::pi * j / count;
        circle.places[static_cast<std::size_t>(j)] = {1.0 + std::sin(angle), 1.0 + std::cos(angle)};
    }
    return circle;
}

ActuatorLayout gridLayout(int count, int rows) {
    const ActuatorLayout phone = presetLayout("phone4").geometry;
    ActuatorLayout grid{phone.extentWidthMetres, phone.extentHeightMetres, count, {}};
    const int columns = count / rows;
    const auto share = [](int i, int n) { return n > 1 ? static_cast<double>(i) / (n - 1) : 0.5; };
    for (int j = 0; j < count; ++j)
        grid.places[static_cast<std::size_t>(j)] = {share(j % columns, columns) * grid.extentWidthMetres,
                                                    (1.0 - share(j / columns, rows)) *
                                                        grid.extentHeightMetres};
    return grid;
}

LayoutDescription arrangedLayout(Arrangement arrangement, int count) {
    count = std::clamp(count, 1, limits::maxActuators);
    if (arrangement == Arrangement::belt && count > 2)
        return describeLayout(count == 8 ? "belt of eight" : "belt of " + std::to_string(count),
                              beltLayout(count));
    int rows = 1;
    for (int r = 2; arrangement == Arrangement::grid && r * r <= count; ++r)
        if (count % r == 0) rows = r;
    if (count <= 2 || (count == 4 && rows == 2)) return presetLayout("phone" + std::to_string(count));
    return describeLayout((rows > 1 ? "grid of " : "row of ") + std::to_string(count),
                          gridLayout(count, rows));
}

/// The instrument that a state plays; null: a scene.
const Instrument* findInstrument(const PluginState& state) {
    const auto found = std::ranges::find(instruments(), state.scene.name, &Instrument::name);
    return found == instruments().end() ? nullptr : &*found;
}

void resetInstrument(PluginState& state) {
    for (const auto which : parameterTable::instrumentGroup) setParameter(state, which, rowOf(which).initial);
}

void applyInstrument(PluginState& state, const Instrument& instrument, int outputs) {
    state.scene = bodilessScene(instrument);
    rearrange(state, outputs > 0 ? outputs : instrument.actuators);
    state.voice = instrument.voice;
    state.notes.clear();
    for (auto material = static_cast<int>(state.scene.materials.size() - instrument.kit.size());
         const KitNote& note : instrument.kit)
        state.notes.push_back({.note = note.note, .material = material++, .x = note.x, .y = note.y});
    setParameter(state, Parameter::strikeLevel, instrument.strikeDb);
    setParameter(state, Parameter::beats, instrument.beats);
    resetInstrument(state);
}

constexpr int sceneActuators = 4;

/// True if the actuators' places are none that arrangedLayout() makes.
bool isCustomLayout(const PluginState& state) {
    const auto& geometry = state.layout.geometry;
    return std::ranges::none_of(
        std::array{Arrangement::grid, Arrangement::row, Arrangement::belt},
        [&geometry](Arrangement a) { return isSame(arrangedLayout(a, geometry.count).geometry, geometry); });
}

// Nothing of the preset before stays, so that it does not matter which it was.
void applyScene(PluginState& state, const Scene& scene, int outputs) {
    state.voice = {};
    state.notes.clear();
    setScene(state, scene);
    if (!isCustomLayout(state) || (outputs > 0 && outputs < actuatorCount(state)))
        rearrange(state, outputs > 0 ? outputs : sceneActuators);
    state.scene.driveGain *= driveFactorOf(state.scene.name, actuatorCount(state));
    for (const auto which : {Parameter::strikeLevel, Parameter::beats})
        setParameter(state, which, rowOf(which).initial);
    resetInstrument(state);
}

} // namespace

const std::vector<std::string>& presetNames() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& scene : builtInScenes()) all.push_back(scene.name);
        for (const auto& instrument : instruments()) all.emplace_back(instrument.name);
        return all;
    }();
    return names;
}

std::string displayName(std::string name) {
    if (std::ranges::find(builtInScenes(), name, &Scene::name) == builtInScenes().end()) return name;
    std::ranges::replace(name, '-', ' ');
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    return name;
}

// By the name alone: a built-in scene may have changed since a session was saved.
int findPresetIndex(const PluginState& state) {
    const auto& names = presetNames();
    const auto found = std::ranges::find(names, state.scene.name);
    return found == names.end() ? 0 : static_cast<int>(found - names.begin());
}

void rearrange(PluginState& state, int outputs) {
    const auto* const instrument = findInstrument(state);
    const auto before = std::exchange(
        state.layout, arrangedLayout(instrument ? instrument->arrangement : Arrangement::grid, outputs));
    copyActuatorProperties(state.layout, before.actuators);
    fitToLayout(state);
}

void applyBuiltInPreset(PluginState& state, int index, int outputs) {
    const auto& scenes = builtInScenes();
    const auto i = static_cast<std::size_t>(index);
    if (i >= scenes.size()) return applyInstrument(state, instruments().at(i - scenes.size()), outputs);
    applyScene(state, scenes[i], outputs);
}

double presetStrikeDb(const PluginState& state) {
    const auto* const instrument = findInstrument(state);
    return std::max(rowOf(Parameter::strikeLevel).initial, instrument ? instrument->strikeDb : 0.0);
}

PluginState newPluginState(int outputs) {
    PluginState state;
    applyInstrument(state, instruments().front(), outputs);
    return state;
}

} // namespace physvib
