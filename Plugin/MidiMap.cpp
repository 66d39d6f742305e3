// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the tables of notes and controllers and the action groups from the rules of a state.
#include "MidiMap.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <string>

namespace physvib {

namespace {

constexpr int notesPerOctave = 12;

std::vector<int> vibratingMaterials(const Scene& scene) {
    std::vector<int> found;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].frequencyHz > 0.0) found.push_back(static_cast<int>(i));
    return found;
}

constexpr double minPitchHz = 20.0, maxPitchHz = 500.0;

double pitchHz(int note) {
    double frequencyHz = 440.0 * portable::pow(2.0, (note - 69) / 12.0);
    while (frequencyHz < minPitchHz) frequencyHz *= 2.0;
    while (frequencyHz > maxPitchHz) frequencyHz /= 2.0;
    return frequencyHz;
}

/// Place of a note without a rule, as shares of the field, 0 to 1.
Vector placeOf(int note, NotePlacement places, const ActuatorLayout& layout) noexcept {
    const auto& place = layout.places[static_cast<std::size_t>(note % std::max(1, layout.count))];
    switch (places) {
    case NotePlacement::octave: return {(note % notesPerOctave) / (notesPerOctave - 1.0), 0.5};
    case NotePlacement::actuators:
        return {place.xMetres / layout.extentWidthMetres, place.yMetres / layout.extentHeightMetres};
    case NotePlacement::middle: break;
    }
    return {0.5, 0.5};
}

CollisionEvent strikeFor(const NoteRule& rule, const Scene& scene) {
    CollisionEvent strike;
    if (rule.material < 0 || rule.material >= static_cast<int>(scene.materials.size())) return strike;
    const Material& material = scene.materials[static_cast<std::size_t>(rule.material)];
    strike.frequencyHz = material.frequencyHz;
    strike.decayPerSecond = material.decayPerSecond;
    strike.amplitude = 1.0;
    strike.x = rule.x * scene.fieldWidthMetres;
    strike.y = rule.y * scene.fieldHeightMetres;
    return strike;
}

// The strike of a note without a rule; frequency 0: it strikes nothing.
CollisionEvent strikeFor(int note, const PluginState& state, const std::vector<int>& materials) {
    const Vector place = placeOf(note, state.voice.placement, state.layout.geometry);
    const auto octave = static_cast<std::size_t>(note / notesPerOctave);
    const NoteRule rule{.material = materials.empty() ? -1 : materials[octave % materials.size()],
                        .x = place.x,
                        .y = place.y};
    CollisionEvent strike = strikeFor(rule, state.scene);
    if (state.voice.pitch == NotePitch::material) return strike;
    strike.frequencyHz = pitchHz(note);
    strike.decayPerSecond = state.voice.decayPerSecond;
    strike.amplitude = 1.0;
    strike.x = rule.x * state.scene.fieldWidthMetres;
    strike.y = rule.y * state.scene.fieldHeightMetres;
    return strike;
}

constexpr int sceneMaterial = -1;

// Gives `material` to every fixture that is felt; sceneMaterial: each its own.
std::vector<Action> materialActions(const Scene& scene, int material) {
    std::vector<Action> actions;
    for (const auto& body : scene.bodies)
        for (std::size_t f = 0; f < body.fixtures.size(); ++f)
            if (body.fixtures[f].isCamera)
                actions.push_back(
                    MaterialAction{body.name, static_cast<int>(f),
                                   material == sceneMaterial ? body.fixtures[f].material : material});
    return actions;
}

std::vector<Action> noteActions(const NoteRule& rule, const Scene& scene) {
    if (rule.kind == NoteKind::push) return {ImpulseAction{rule.object, rule.atFullVelocity, {}}};
    if (rule.kind == NoteKind::strike) return {};
    SpawnAction spawn;
    spawn.body.name = "note " + std::to_string(rule.note);
    const FixtureDescription disc{CircleShape{rule.radiusMetres}, {}, 0.0, rule.material};
    spawn.body.fixtures.push_back(disc);
    spawn.body.positionMetres = {rule.x * scene.fieldWidthMetres, rule.y * scene.fieldHeightMetres};
    spawn.body.velocityMetresPerSecond = rule.atFullVelocity;
    return {spawn};
}

} // namespace

std::vector<std::vector<Action>> actionGroups(const PluginState& state) {
    std::vector<std::vector<Action>> groups;
    for (int m = sceneMaterial; m < static_cast<int>(state.scene.materials.size()); ++m) {
        const bool canVibrate =
            m == sceneMaterial || state.scene.materials[static_cast<std::size_t>(m)].frequencyHz > 0.0;
        groups.push_back(canVibrate ? materialActions(state.scene, m) : std::vector<Action>{});
    }
    for (const auto& rule : state.notes) groups.push_back(noteActions(rule, state.scene));
    return groups;
}

MidiTable::MidiTable(const PluginState& state)
    : voice_{state.voice}
    , fieldWidthMetres_{state.scene.fieldWidthMetres}
    , fieldHeightMetres_{state.scene.fieldHeightMetres} {
    const auto materials = vibratingMaterials(state.scene);
    for (int note = 0; note < 128; ++note)
        strikes_[static_cast<std::size_t>(note)] = strikeFor(note, state, materials);
    isHeld_.fill(voice_.isHeld && voice_.pitch == NotePitch::note);
    for (std::size_t m = 0; m < std::min(state.scene.materials.size(), sounds_.size() - 1); ++m)
        sounds_[m + 1] = {state.scene.materials[m].frequencyHz, state.scene.materials[m].decayPerSecond};
    actionGroups_.fill(-1);
    materialCount_ = static_cast<int>(state.scene.materials.size());
    for (int group = materialCount_ + 1; const auto& rule : state.notes) {
        const auto note = static_cast<std::size_t>(rule.note & 127);
        if (rule.kind == NoteKind::strike) strikes_[note] = strikeFor(rule, state.scene);
        isHeld_[note] = false;
        hasRule_[note] = true;
        actionGroups_[note] = rule.kind == NoteKind::strike ? -1 : group;
        ++group;
    }
    parameters_.fill(-1);
    for (const auto& rule : state.controllers)
        parameters_[static_cast<std::size_t>(rule.controller & 127)] = findParameter(rule.parameter);
}

CollisionEvent MidiTable::strikeOf(int note, const NoteKnobs& knobs,
                                   const ActuatorLayout& layout) const noexcept {
    CollisionEvent strike = strikeOf(note);
    if (!hasRule_[static_cast<std::size_t>(note & 127)]) {
        if (const Sound& sound = sounds_[static_cast<std::size_t>(knobs.material)]; sound.frequencyHz > 0.0) {
            strike.frequencyHz = sound.frequencyHz;
            strike.decayPerSecond = sound.decayPerSecond;
            strike.amplitude = 1.0;
        }
        if (knobs.placement > 0 || strikeOf(note).frequencyHz <= 0.0) {
            const auto places =
                knobs.placement > 0 ? static_cast<NotePlacement>(knobs.placement - 1) : voice_.placement;
            const Vector place = placeOf(note, places, layout);
            strike.x = place.x * fieldWidthMetres_;
            strike.y = place.y * fieldHeightMetres_;
        }
    }
    if (knobs.decay != 1.0)
        strike.decayPerSecond = std::min(strike.decayPerSecond / knobs.decay, limits::maxDecayPerSecond);
    return strike;
}

NoteVoice adjustedVoice(NoteVoice voice, const NoteKnobs& knobs) noexcept {
    voice.isHeld = knobs.hold == 0 ? voice.isHeld && voice.pitch == NotePitch::note : knobs.hold == 2;
    if (knobs.placement > 0) voice.placement = static_cast<NotePlacement>(knobs.placement - 1);
    if (knobs.bend > 0)
        voice.bendSemitones = parameterTable::bendSemitones[static_cast<std::size_t>(knobs.bend)];
    voice.decayPerSecond = std::min(voice.decayPerSecond / knobs.decay, limits::maxDecayPerSecond);
    voice.releaseSeconds *= knobs.release;
    voice.velocityExponent *= knobs.velocityCurve;
    return voice;
}

double MidiTable::releasePerSecond(const NoteKnobs& knobs) const noexcept {
    return portable::log(1000.0) / (voice_.releaseSeconds * knobs.release);
}

double MidiTable::velocityAmplitude(int velocity, const NoteKnobs& knobs) const noexcept {
    const double exponent = voice_.velocityExponent * knobs.velocityCurve, share = velocity / 127.0;
    return exponent == 1.0 ? share : portable::pow(share, exponent);
}

} // namespace physvib
