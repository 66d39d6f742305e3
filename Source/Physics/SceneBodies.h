// SPDX-License-Identifier: MIT
// Builds the Box2D bodies of a scene.
#pragma once
#include "Physics/Scene.h"
#include <box2d/box2d.h>
#include <random>

namespace physvib {

/// Mass of a body from the printed density and its area (SPEC erratum 10), kg. Any thread.
double massKg(const BodyDescription& body, const Scene& scene) noexcept;

/// A small seeded departure from the described start; the draws of a body depend on its place in the scene
/// only.
struct StartJitter {
    double xMetres = 0.0, yMetres = 0.0;
    double angleRadians = 0.0;
    double xMetresPerSecond = 0.0, yMetresPerSecond = 0.0;
};

/// Five uniform draws, up to 1 mm, 1 mrad and 1 mm/s each way: a fall from 1 m shifts by at most 0.33 ms,
/// while a box full of bodies is another one after some hits.
StartJitter drawJitter(std::mt19937& random) noexcept;

/// Creates a scene's body with its one fixture, outlines exactly as described. Bodies that cross their own
/// thickness within a step at twice v_max (Eq. 5.7) are bullets. The scene must be valid. M only.
b2Fixture& createBody(b2World& world, const Scene& scene, const BodyDescription& body,
                      const StartJitter& jitter, double stepSeconds);

} // namespace physvib
