// SPDX-License-Identifier: GPL-3.0-or-later
// Describes an impact in words: material, level and place.
#pragma once
#include "Core/CollisionEvent.h"
#include "Live/Documents/Mix.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

/// Index of the material with this frequency and decay; -1: none.
int materialOf(const Scene& scene, const CollisionEvent& hit);
/// The material's name, or "hit".
juce::String materialName(const Scene& scene, const CollisionEvent& hit);

struct FeltMost {
    int enchanter = 0;
    double levelG = 0.0; ///< at that actuator, by its full scale and the master level; before strip and
                         ///< limiter
};
FeltMost feltMost(const Mix& mix, const CollisionEvent& hit);

/// "at the bottom left"
juce::String placeText(const Scene& scene, const CollisionEvent& hit);

} // namespace physvib
