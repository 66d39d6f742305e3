// SPDX-License-Identifier: GPL-3.0-or-later
// Derives panner, session settings, tail length and parameter values from a plug-in state.
#include "PluginSettings.h"
#include "Io/Text/NameList.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace physvib {

void fitToLayout(PluginState& state) {
    resizeStrips(state.strips, enchantersOf(state));
    std::fill(state.equalised.begin() + enchantersOf(state), state.equalised.end(), EqualisedActuator{});
}

void takePreset(PluginState& state, std::string_view name) {
    state.layout = presetLayout(name, state.layout.enchanters);
    fitToLayout(state);
}

void takeScene(PluginState& state, Scene scene) {
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

} // namespace physvib
