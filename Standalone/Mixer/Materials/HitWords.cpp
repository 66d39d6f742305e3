// SPDX-License-Identifier: GPL-3.0-or-later
// Names of what is felt in an impact: its material, its place, its strongest actuator.
#include "Mixer/Materials/HitWords.h"
#include "Core/NameNumbers.h"
#include <cmath>

namespace physvib {

int materialOf(const Scene& scene, const CollisionEvent& hit) {
    const auto sounds = [&hit](const Material& m) { return hit.sound == soundOfMaterial(m.name); };
    const auto found = std::ranges::find_if(scene.materials, sounds);
    return found == scene.materials.end() ? -1 : static_cast<int>(found - scene.materials.begin());
}

juce::String materialName(const Scene& scene, const CollisionEvent& hit) {
    const int index = materialOf(scene, hit);
    return isClip(hit.sound) ? juce::String{"clip"}
           : index < 0       ? juce::String{"hit"}
                             : utf8(scene.materials[static_cast<std::size_t>(index)].name);
}

FeltMost feltMost(const Mix& mix, const CollisionEvent& hit) {
    PhantomPanner::Gains gains{};
    mix.panner().gainsOf(hit, Spread::layout, gains);
    FeltMost most;
    for (int j = 0; j < mix.count(); ++j) {
        const auto i = static_cast<std::size_t>(j);
        const double g =
            std::abs(hit.amplitude) * gains[i] * mix.layout.enchanters[i].fullScaleG * masterGain(mix);
        if (g > most.levelG) most = {j, g};
    }
    return most;
}

juce::String placeText(const Scene& scene, const CollisionEvent& hit) {
    const double x = hit.x / scene.fieldWidthMetres, y = hit.y / scene.fieldHeightMetres;
    const juce::String column = x < 0.15   ? "left"
                                : x > 0.85 ? "right"
                                           : "",
                       row = y < 0.15   ? "bottom"
                             : y > 0.85 ? "top"
                                        : "";
    return column.isEmpty() && row.isEmpty() ? juce::String{"in the middle"}
                                             : "at the " + (row + " " + column).trim();
}

} // namespace physvib
