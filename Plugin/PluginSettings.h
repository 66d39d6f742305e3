// SPDX-License-Identifier: GPL-3.0-or-later
// What an instance of the plug-in plays, apart from its parameters.
#pragma once
#include "Files/LayoutFile.h"
#include "Files/SceneCatalogue.h"
#include "Host/Session.h"
#include "MidiMap.h"
#include <cmath>

namespace physvib {

enum class TransportMode {
    free,         ///< the scene runs whenever the host renders
    restartOnPlay ///< the scene starts at its seed whenever the transport starts or jumps, and is silent while it stands
};

struct PluginSettings {
    Scene scene = *findBuiltInScene("shake-the-box");
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    LayoutDescription layout = presetLayout("phone4");
    bool limiterEnabled = true;
    TransportMode transport = TransportMode::free;
    MidiMap midi;

    static LayoutDescription presetLayout(std::string_view name) {
        EnchanterLayout geometry;
        layoutPreset(name, geometry);
        return describeLayout(std::string{name}, geometry);
    }
    int enchanters() const noexcept { return layout.geometry.count; }
    PhantomPanner panner(PanningLaw law, double exponent) const noexcept {
        return {layout.geometry, law, exponent, scene.fieldWidthMetres, scene.fieldHeightMetres};
    }
    SessionSetup session() const {
        SessionSetup setup;
        setup.scene = scene;
        setup.seed = seed;
        setup.stepsPerSecond = stepsPerSecond;
        setup.channels = enchanters();
        setup.panner = panner(PanningLaw::linear, 1.0);
        setup.limiterEnabled = limiterEnabled;
        return setup;
    }
    /// From a strike at full scale until it has fallen out of hearing, at the smallest decay of the scene.
    double longestRingSeconds() const noexcept {
        double least = limits::maxDecayPerSecond;
        for (const auto& m : scene.materials)
            if (m.frequencyHz > 0.0 && m.decayPerSecond > 0.0) least = std::min(least, m.decayPerSecond);
        return limits::retireDecibels / 20.0 * std::log(10.0) / least;
    }
};

} // namespace physvib
