// SPDX-License-Identifier: GPL-3.0-or-later
// Derives panner, session settings, tail length and parameter values from a plug-in state.
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
    resizeStrips(state.strips, enchantersOf(state));
    std::fill(state.equalised.begin() + enchantersOf(state), state.equalised.end(), EqualisedActuator{});
}

void usePreset(PluginState& state, std::string_view name) {
    state.layout = presetLayout(name, state.layout.enchanters);
    fitToLayout(state);
}

void useScene(PluginState& state, Scene scene) {
    const Scene before = std::exchange(state.scene, std::move(scene));
    for (const NoteRule& rule : std::exchange(state.notes, {})) {
        NoteRule kept = rule;
        if (rule.kind == NoteKind::push) {
            if (std::ranges::find(state.scene.bodies, rule.object, &BodyDescription::name) ==
                state.scene.bodies.end())
                continue;
        } else {
            const auto& materials = state.scene.materials;
            const auto found = std::ranges::find(
                materials, before.materials[static_cast<std::size_t>(rule.material)].name, &Material::name);
            if (found == materials.end()) continue;
            kept.material = static_cast<int>(found - materials.begin());
        }
        state.notes.push_back(kept);
    }
}

bool isSameTake(const PluginState& a, const PluginState& b) {
    return a.seed == b.seed && a.stepsPerSecond == b.stepsPerSecond && a.limiterEnabled == b.limiterEnabled &&
           a.transport == b.transport && a.isDirect == b.isDirect &&
           isSame(a.layout.geometry, b.layout.geometry) && a.equalised == b.equalised && a.voice == b.voice &&
           a.notes == b.notes && a.controllers == b.controllers && a.scene == b.scene;
}

PhantomPanner pannerOf(const PluginState& state, PanningLaw law, double exponent) noexcept {
    return {state.layout.geometry, law, exponent, state.scene.fieldWidthMetres,
            state.scene.fieldHeightMetres};
}

SessionSetup sessionSetupOf(const PluginState& state) {
    SessionSetup setup;
    setup.scene = state.scene;
    setup.seed = state.seed;
    setup.stepsPerSecond = state.stepsPerSecond;
    setup.hasWorld = hasWorld(state);
    setup.channels = enchantersOf(state);
    setup.modes = 256; // a take's memory follows it, and a host holds many; what it steals beyond is shown
    setup.panner = pannerOf(state, PanningLaw::linear, 1.0);
    setup.limiterEnabled = state.limiterEnabled;
    setup.equalised = state.equalised;
    setup.groups = actionGroups(state);
    if (state.isDirect) setup.direct = Direct::fromStart;
    setup.log = LogUse::none; // a host plays for months, and has a project of its own
    return setup;
}

bool hasWorld(const PluginState& state) noexcept {
    const auto& scene = state.scene;
    return !scene.bodies.empty() || !scene.script.empty() || !scene.inputs.empty() ||
           std::ranges::any_of(state.notes,
                               [](const NoteRule& rule) { return rule.kind == NoteKind::spawn; });
}

bool uses(const PluginState& state, const NoteKnobs& knobs, Parameter which) noexcept {
    const bool isHeld = voiceBy(state.voice, knobs).isHeld;
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
    double least = limits::maxDecayPerSecond;
    const NoteVoice voice = voiceBy(state.voice, knobs);
    if (voice.isHeld)
        least = std::log(1000.0) / voice.releaseSeconds;
    else if (voice.pitch == NotePitch::note)
        least = voice.decayPerSecond;
    for (const auto& m : state.scene.materials)
        if (m.frequencyHz > 0.0 && m.decayPerSecond > 0.0)
            least = std::min(least, m.decayPerSecond / knobs.decay);
    return limits::retireDecibels / 20.0 * std::log(10.0) / least;
}

ParameterValue stateValue(const ParameterRow& row, double value) {
    if (row.choices.empty()) return value;
    return valueText(row, value);
}

std::optional<double> valueOfState(const ParameterRow& row, const ParameterValue& value) {
    if (const auto* const number = std::get_if<double>(&value)) return *number;
    const auto& word = std::get<std::string>(value);
    if (std::ranges::find(row.choices, word) == row.choices.end()) return {};
    return valueOf(row, word);
}

double valueIn(const PluginState& state, Parameter which) {
    const auto& row = rowOf(which);
    const auto found =
        std::ranges::find(state.parameters, row.id, &std::pair<std::string, ParameterValue>::first);
    return found == state.parameters.end() ? row.initial
                                           : valueOfState(row, found->second).value_or(row.initial);
}

void setParameter(PluginState& state, Parameter which, double value) {
    const auto& row = rowOf(which);
    std::erase_if(state.parameters, [&row](const auto& p) { return p.first == row.id; });
    state.parameters.emplace_back(row.id, std::clamp(value, row.least, row.most));
}

std::string faultOfParameters(const PluginState& state) {
    const auto noSuch = [](const std::string& id) { return "no parameter \"" + id + "\""; };
    for (const auto& [id, value] : state.parameters) {
        const int which = parameterOfId(id);
        if (which < 0) return noSuch(id);
        if (const auto& row = rowOf(static_cast<Parameter>(which)); !valueOfState(row, value))
            return "parameters." + id + ": expected " +
                   (row.choices.empty() ? "a number" : "one of " + listed(row.choices)) + ", found \"" +
                   std::get<std::string>(value) + "\"";
    }
    for (const auto& rule : state.controllers)
        if (parameterOfId(rule.parameter) < 0) return noSuch(rule.parameter);
    return {};
}

namespace {

/// A note of a kit: what it sounds like, and where, in parts of the field.
struct KitNote {
    int note;
    std::string_view material;
    double frequencyHz, decayPerSecond, x, y;
};

// Where General MIDI has them; low ones below, short ones above.
constexpr std::array drumKit{
    KitNote{36, "kick", 48, 14, 0.5, 0.0},         KitNote{38, "snare", 170, 34, 0.0, 0.5},
    KitNote{42, "closed hat", 320, 110, 1.0, 1.0}, KitNote{46, "open hat", 300, 16, 1.0, 0.8},
    KitNote{41, "low tom", 70, 12, 0.0, 0.0},      KitNote{45, "middle tom", 95, 14, 0.35, 0.6},
    KitNote{48, "high tom", 125, 16, 0.65, 0.6},   KitNote{49, "crash", 260, 6, 0.0, 1.0},
    KitNote{51, "ride", 280, 9, 1.0, 0.4}};
constexpr std::array clicks{KitNote{60, "click", 250, 120, 0.5, 0.5},
                            KitNote{61, "low click", 120, 80, 0.5, 0.5}};
constexpr std::array heart{KitNote{60, "first beat", 42, 16, 0.4, 0.4},
                           KitNote{61, "second beat", 55, 20, 0.6, 0.6}};

/// How a preset arranges its actuators, however many there are. Its notes have places in parts of the field,
/// which the layout's extent covers: so they are projected on the actuators that are there.
enum class Arrangement {
    grid, ///< row by row from the upper left, as near to a square as the number allows
    row,  ///< from left to right
    belt  ///< from above on a circle, A in front, then clockwise
};

struct Instrument {
    std::string_view name;
    Arrangement arrangement;
    int actuators;   ///< that it is made for
    double strikeDb; ///< strike level: all are felt as strongly (Tests/Plugin/LoudnessTest.cpp measures it)
    NoteVoice voice;
    std::span<const KitNote> kit{};
    double beats = 0.0; ///< per cent
};

NoteVoice voice(NotePlaces places, double decayPerSecond) {
    return {.pitch = NotePitch::note, .places = places, .isLoudest = true, .decayPerSecond = decayPerSecond};
}

NoteVoice held(NotePlaces places, double releaseSeconds, double bendSemitones) {
    return {.pitch = NotePitch::note,
            .places = places,
            .isHeld = true,
            .isLoudest = true,
            .decayPerSecond = 10.0,
            .releaseSeconds = releaseSeconds,
            .bendSemitones = bendSemitones};
}

const std::vector<Instrument>& instruments() {
    using enum NotePlaces;
    using enum Arrangement;
    static const std::vector<Instrument> all{
        {"Keys", grid, 4, 6.0, voice(octave, 12.0)},
        {"Drum kit", grid, 4, 5.0, voice(octave, 20.0), drumKit},
        {"Bass", grid, 4, 2.5, voice(middle, 4.0)},
        {"Strings", grid, 4, 0.0, held(octave, 0.4, 2.0)},
        {"Stereo pair", row, 2, 0.0, held(octave, 0.1, 2.0)},
        {"Four corners", grid, 4, 6.0, voice(actuators, 15.0)},
        {"Belt of eight", belt, 8, 8.0, voice(actuators, 25.0)},
        {"Sweep", grid, 4, 0.0, held(middle, 0.2, 24.0)},
        {"MPE pad", grid, 4, 0.0, held(octave, 0.8, 48.0)},
        {"Clicks", grid, 4, 12.0, voice(middle, 120.0), clicks},
        {"Heartbeat", grid, 4, 6.0, voice(middle, 16.0), heart},
        {"Beats of the music", grid, 4, 6.0, voice(octave, 20.0), {}, 50.0},
    };
    return all;
}

/// Factor on a scene's own drive, so that it is felt as strongly as an instrument on that many actuators: on
/// more, each gets less of an impact (Tests/Plugin/LoudnessTest.cpp measures it).
double driveOf(std::string_view scene, int actuators) noexcept {
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
    const int width = std::bit_width(static_cast<unsigned int>(std::clamp(actuators, 1, 16))) - 1;
    return found == drives.end() ? 8.0 : found->factors[static_cast<std::size_t>(width)];
}

/// No bodies: materials, and a field to be struck.
Scene emptyField(const Instrument& instrument) {
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

EnchanterLayout beltOf(int count) {
    // On a circle the last and the first are neighbours: a note on one actuator is not shared among all.
    EnchanterLayout circle{2.0, 2.0, count, {}};
    for (int j = 0; j < count; ++j) {
        const double angle = 2.0 * std::numbers::pi * j / count;
        circle.places[static_cast<std::size_t>(j)] = {1.0 + std::sin(angle), 1.0 + std::cos(angle)};
    }
    return circle;
}

EnchanterLayout gridOf(int count, int rows) {
    const EnchanterLayout phone = presetLayout("phone4").geometry;
    EnchanterLayout grid{phone.extentWidthMetres, phone.extentHeightMetres, count, {}};
    const int columns = count / rows;
    const auto share = [](int i, int n) { return n > 1 ? static_cast<double>(i) / (n - 1) : 0.5; };
    for (int j = 0; j < count; ++j)
        grid.places[static_cast<std::size_t>(j)] = {share(j % columns, columns) * grid.extentWidthMetres,
                                                    (1.0 - share(j / columns, rows)) *
                                                        grid.extentHeightMetres};
    return grid;
}

LayoutDescription layoutOf(Arrangement arrangement, int count) {
    count = std::clamp(count, 1, limits::maxEnchanters);
    if (arrangement == Arrangement::belt && count > 2)
        return describeLayout(count == 8 ? "belt of eight" : "belt of " + std::to_string(count),
                              beltOf(count));
    int rows = 1;
    for (int r = 2; arrangement == Arrangement::grid && r * r <= count; ++r)
        if (count % r == 0) rows = r;
    if (count <= 2 || (count == 4 && rows == 2)) return presetLayout("phone" + std::to_string(count));
    return describeLayout((rows > 1 ? "grid of " : "row of ") + std::to_string(count), gridOf(count, rows));
}

/// Null: a scene.
const Instrument* instrumentOf(const PluginState& state) {
    const auto found = std::ranges::find(instruments(), state.scene.name, &Instrument::name);
    return found == instruments().end() ? nullptr : &*found;
}

void resetInstrument(PluginState& state) {
    for (const auto which : parameterTable::instrumentGroup) setParameter(state, which, rowOf(which).initial);
}

void take(PluginState& state, const Instrument& instrument, int outputs) {
    state.scene = emptyField(instrument);
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

/// Places that no preset gives.
bool isOwnLayout(const PluginState& state) {
    const auto& own = state.layout.geometry;
    return std::ranges::none_of(
        std::array{Arrangement::grid, Arrangement::row, Arrangement::belt},
        [&own](Arrangement each) { return isSame(layoutOf(each, own.count).geometry, own); });
}

// As chosen from anywhere: nothing of the preset before stays.
void take(PluginState& state, const Scene& scene, int outputs) {
    state.voice = {};
    state.notes.clear();
    useScene(state, scene);
    if (!isOwnLayout(state) || (outputs > 0 && outputs < enchantersOf(state)))
        rearrange(state, outputs > 0 ? outputs : sceneActuators);
    state.scene.driveGain *= driveOf(state.scene.name, enchantersOf(state));
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

std::string shownName(std::string name) {
    if (std::ranges::find(builtInScenes(), name, &Scene::name) == builtInScenes().end()) return name;
    std::ranges::replace(name, '-', ' ');
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    return name;
}

// Scenes of today's name may have been others when a session was saved.
int presetOf(const PluginState& state) {
    const auto& names = presetNames();
    const auto found = std::ranges::find(names, state.scene.name);
    return found == names.end() ? 0 : static_cast<int>(found - names.begin());
}

void rearrange(PluginState& state, int outputs) {
    const auto* const instrument = instrumentOf(state);
    const auto before = std::exchange(
        state.layout, layoutOf(instrument ? instrument->arrangement : Arrangement::grid, outputs));
    keepActuators(state.layout, before.enchanters);
    fitToLayout(state);
}

void useBuiltIn(PluginState& state, int index, int outputs) {
    const auto& scenes = builtInScenes();
    const auto at = static_cast<std::size_t>(index);
    if (at >= scenes.size()) return take(state, instruments().at(at - scenes.size()), outputs);
    take(state, scenes[at], outputs);
}

double usualStrikeDb(const PluginState& state) {
    const auto* const instrument = instrumentOf(state);
    return std::max(rowOf(Parameter::strikeLevel).initial, instrument ? instrument->strikeDb : 0.0);
}

PluginState newPluginState(int outputs) {
    PluginState state;
    take(state, instruments().front(), outputs);
    return state;
}

} // namespace physvib
