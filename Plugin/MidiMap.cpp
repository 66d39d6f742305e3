// SPDX-License-Identifier: GPL-3.0-or-later
// From rules to a table.
#include "MidiMap.h"

namespace physvib {

namespace {

constexpr int notesPerOctave = 12;

std::vector<int> vibratingMaterials(const Scene& scene) {
    std::vector<int> found;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].frequencyHz > 0.0) found.push_back(static_cast<int>(i));
    return found;
}

NoteRule defaultRule(int note, const std::vector<int>& materials) {
    const auto octave = static_cast<std::size_t>(note / notesPerOctave);
    return {note, materials[octave % materials.size()], (note % notesPerOctave) / (notesPerOctave - 1.0), 0.5};
}

CollisionEvent strikeBy(const NoteRule& rule, const Scene& scene) {
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

} // namespace

std::vector<ControllerRule> defaultControllers() { return {{1, "tilt"}, {7, "level"}, {16, "gravity"}, {17, "exponent"}}; }

MidiTable::MidiTable(const PluginState& state)
    : width_{state.scene.fieldWidthMetres}
    , height_{state.scene.fieldHeightMetres} {
    const auto materials = vibratingMaterials(state.scene);
    for (int note = 0; note < 128 && !materials.empty(); ++note)
        strikes_[static_cast<std::size_t>(note)] = strikeBy(defaultRule(note, materials), state.scene);
    for (const auto& rule : state.notes) strikes_[static_cast<std::size_t>(rule.note & 127)] = strikeBy(rule, state.scene);
    parameters_.fill(-1);
    for (const auto& rule : state.controllers) parameters_[static_cast<std::size_t>(rule.controller & 127)] = parameterOfId(rule.parameter);
}

} // namespace physvib
