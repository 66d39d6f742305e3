// SPDX-License-Identifier: GPL-3.0-or-later
// Table of the instrument presets: layout, voice, strike level, and notes with their own sound and place.
#include "Presets.h"
#include "Parameters.h"
#include "PluginSettings.h"
#include "Scene/SceneCatalogue.h"
#include <algorithm>
#include <array>
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

struct Instrument {
    std::string_view name;
    std::string_view layout; ///< a preset, or `belt`
    NoteVoice voice;
    std::span<const KitNote> kit{};
    double beats = 0.0; ///< per cent
};

constexpr std::string_view belt = "belt of eight";

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
    static const std::vector<Instrument> all{
        {"Keys", "phone4", voice(octave, 12.0)},
        {"Drum kit", "phone4", voice(octave, 20.0), drumKit},
        {"Bass", "phone4", voice(middle, 4.0)},
        {"Strings", "phone4", held(octave, 0.4, 2.0)},
        {"Stereo pair", "phone2", held(octave, 0.1, 2.0)},
        {"Four corners", "phone4", voice(actuators, 15.0)},
        {"Belt of eight", belt, voice(actuators, 25.0)},
        {"Sweep", "phone4", held(middle, 0.2, 24.0)},
        {"MPE pad", "phone4", held(octave, 0.8, 48.0)},
        {"Clicks", "phone4", voice(middle, 120.0), clicks},
        {"Heartbeat", "phone4", voice(middle, 16.0), heart},
        {"Beats of the music", "phone4", voice(octave, 20.0), {}, 50.0},
    };
    return all;
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

LayoutDescription layoutOf(const Instrument& instrument, const LayoutDescription& before) {
    if (instrument.layout != belt) return presetLayout(instrument.layout, before.enchanters);
    // From above, A in front, then clockwise: on a circle the last and the first are neighbours, too, and a
    // note on one actuator is not shared among all, as it is in a row.
    EnchanterLayout circle{2.0, 2.0, 8, {}};
    for (int j = 0; j < circle.count; ++j) {
        const double angle = 2.0 * std::numbers::pi * j / circle.count;
        circle.places[static_cast<std::size_t>(j)] = {1.0 + std::sin(angle), 1.0 + std::cos(angle)};
    }
    return describeLayout(std::string{belt}, circle);
}

void setParameter(PluginState& state, Parameter which, double value) {
    const std::string id{rowOf(which).id};
    std::erase_if(state.parameters, [&](const auto& p) { return p.first == id; });
    state.parameters.emplace_back(id, value);
}

void take(PluginState& state, const Instrument& instrument) {
    state.scene = emptyField(instrument);
    state.layout = layoutOf(instrument, state.layout);
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
    // with the level that is safe at first: -6 dB of full scale
    setParameter(state, Parameter::strikeLevel, rowOf(Parameter::strikeLevel).initial);
    setParameter(state, Parameter::beats, instrument.beats);
    fitToLayout(state);
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

void takePlugInPreset(PluginState& state, int index) {
    const auto& scenes = builtInScenes();
    const auto at = static_cast<std::size_t>(index);
    if (at < scenes.size()) return takeScene(state, scenes[at]);
    take(state, instruments().at(at - scenes.size()));
}

PluginState newPluginState() {
    PluginState state;
    state.layout = presetLayout("phone4");
    take(state, instruments().front());
    return state;
}

} // namespace physvib
