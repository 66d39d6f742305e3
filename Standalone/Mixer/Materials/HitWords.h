// SPDX-License-Identifier: GPL-3.0-or-later
// A hit in physical words.
#pragma once
#include "Core/CollisionEvent.h"
#include "Live/Documents/Mix.h"
#include "Mixer/Window/Parts.h"

namespace physvib {

/// The index of the material that sounds like this; -1: none.
int materialOf(const Scene& scene, const CollisionEvent& hit);
/// Its name, or "hit".
juce::String materialName(const Scene& scene, const CollisionEvent& hit);

struct FeltMost {
    int enchanter = 0;
    double levelG = 0.0; ///< there, by its full scale and the master; before strip and limiter
};
FeltMost feltMost(const Mix& mix, const CollisionEvent& hit);

/// "at the bottom left"
juce::String placeText(const Scene& scene, const CollisionEvent& hit);

} // namespace physvib
