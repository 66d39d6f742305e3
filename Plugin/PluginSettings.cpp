// SPDX-License-Identifier: GPL-3.0-or-later
// Panner, session and tail of a state.
#include "PluginSettings.h"
#include "Files/SceneCatalogue.h"
#include "MidiMap.h"
#include <algorithm>
#include <cmath>

namespace physvib {

LayoutDescription presetLayout(std::string_view name) {
    EnchanterLayout geometry;
    layoutPreset(name, geometry);
    return describeLayout(std::string{name}, geometry);
}

PluginState newPluginState() {
    PluginState state;
    state.scene = builtInScenes().front();
    state.layout = presetLayout("phone4");
    state.controllers = defaultControllers();
    return state;
}

PhantomPanner pannerOf(const PluginState& state, PanningLaw law, double exponent) noexcept {
    return {state.layout.geometry, law, exponent, state.scene.fieldWidthMetres, state.scene.fieldHeightMetres};
}

SessionSetup sessionSetupOf(const PluginState& state) {
    SessionSetup setup;
    setup.scene = state.scene;
    setup.seed = state.seed;
    setup.stepsPerSecond = state.stepsPerSecond;
    setup.channels = enchantersOf(state);
    setup.panner = pannerOf(state, PanningLaw::linear, 1.0);
    setup.limiterEnabled = state.limiterEnabled;
    setup.groups = actionGroups(state);
    return setup;
}

double longestRingSeconds(const PluginState& state) noexcept {
    double least = limits::maxDecayPerSecond;
    for (const auto& m : state.scene.materials)
        if (m.frequencyHz > 0.0 && m.decayPerSecond > 0.0) least = std::min(least, m.decayPerSecond);
    return limits::retireDecibels / 20.0 * std::log(10.0) / least;
}

} // namespace physvib
