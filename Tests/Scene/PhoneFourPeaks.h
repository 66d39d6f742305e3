// SPDX-License-Identifier: MIT
// How loud each of phone4's enchanters gets in a scene, for tests of whole scenes.
#pragma once
#include "Scene/Scene.h"
#include "Support/Rendering.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace physvib {

/// Largest sample of each enchanter, linear law, without the limiter.
inline std::array<double, 4> phoneFourPeaks(const Scene& scene, const std::vector<CollisionEvent>& events,
                                            int seconds) {
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    const PhantomPanner panner{layout, PanningLaw::linear, 1.0, scene.fieldWidthMetres,
                               scene.fieldHeightMetres};
    const auto rendered = test::renderEvents(events, {8000, 4, panner, false}, seconds * 8000, {4096});
    std::array<double, 4> peaks{};
    for (std::size_t j = 0; j < peaks.size(); ++j)
        for (const float sample : rendered.channels[j])
            peaks[j] = std::max(peaks[j], std::abs(double{sample}));
    return peaks;
}

} // namespace physvib
