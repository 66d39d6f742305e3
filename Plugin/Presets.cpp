// SPDX-License-Identifier: GPL-3.0-or-later
// Table of the instrument presets: layout, voice, strike level, and notes with their own sound and place.
#include "Presets.h"
#include "Parameters.h"
#include "PluginSettings.h"
#include "Scene/SceneCatalogue.h"
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>
#include <string_view>

namespace physvib {

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
    NoteVoice v;
    v.pitch = NotePitch::note;
    v.places = places;
    v.isLoudest = true;
    v.decayPerSecond = decayPerSecond;
    return v;
}

NoteVoice held(NotePlaces places, double releaseSeconds, double bendSemitones) {
    NoteVoice v = voice(places, 10.0);
    v.isHeld = true;
    v.releaseSeconds = releaseSeconds;
    v.bendSemitones = bendSemitones;
    return v;
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
    // On a circle the last and the first are neighbours, too, and a note on one actuator is not shared among
    // all, as it is in a row.
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

void setParameter(PluginState& state, Parameter which, double value) {
    const std::string id{rowOf(which).id};
    std::erase_if(state.parameters, [&](const auto& p) { return p.first == id; });
    state.parameters.emplace_back(id, value);
}

void take(PluginState& state, const Instrument& instrument, int outputs) {
    state.scene = emptyField(instrument);
    placeAnew(state, outputs > 0 ? outputs : instrument.actuators);
    state.voice = instrument.voice;
    state.notes.clear();
    const auto first = static_cast<int>(state.scene.materials.size() - instrument.kit.size());
    for (int i = 0; i < std::ssize(instrument.kit); ++i) {
        const KitNote& note = instrument.kit[static_cast<std::size_t>(i)];
        NoteRule rule;
        rule.note = note.note;
        rule.material = first + i;
        rule.x = note.x;
        rule.y = note.y;
        state.notes.push_back(rule);
    }
    setParameter(state, Parameter::strikeLevel, instrument.strikeDb);
    setParameter(state, Parameter::beats, instrument.beats);
    for (const auto which : parameterTable::instrumentGroup) setParameter(state, which, rowOf(which).initial);
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

// Scenes of today's name may have been others when a session was saved.
int presetOf(const PluginState& state) {
    const auto& names = presetNames();
    const auto found = std::ranges::find(names, state.scene.name);
    return found == names.end() ? 0 : static_cast<int>(found - names.begin());
}

void placeAnew(PluginState& state, int outputs) {
    const auto* const instrument = instrumentOf(state);
    const auto before = std::exchange(
        state.layout, layoutOf(instrument ? instrument->arrangement : Arrangement::grid, outputs));
    keepActuators(state.layout, before.enchanters);
    fitToLayout(state);
}

void takePlugInPreset(PluginState& state, int index, int outputs) {
    const auto& scenes = builtInScenes();
    const auto at = static_cast<std::size_t>(index);
    if (at >= scenes.size()) return take(state, instruments().at(at - scenes.size()), outputs);
    takeScene(state, scenes[at]);
    if (outputs > 0 && outputs < enchantersOf(state)) placeAnew(state, outputs);
    state.scene.driveGain *= driveOf(state.scene.name, enchantersOf(state));
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
