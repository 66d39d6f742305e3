// SPDX-License-Identifier: MIT
// Says what is wrong with a scene, before a world is built from it.
#pragma once
#include "Physics/Scene.h"
#include <string>

namespace physvib {

/// Ranges of a scene: wide of anything one would build, but inside what Box2D's float arithmetic can bear.
namespace sceneLimits {
constexpr double minSizeMetres = 0.01; // Box2D's own tolerance is 5 mm
constexpr double maxSizeMetres = 100.0;
constexpr double maxPositionMetres = 1000.0;
constexpr double minDensityKgPerSquareMetre = 0.001;
constexpr double maxDensityKgPerSquareMetre = 100'000.0;
constexpr double maxFriction = 100.0;
constexpr double maxStaticMassKg = 1.0e9;
constexpr double maxAccelerationMetresPerSecond2 = 1000.0;
constexpr double maxScriptSeconds = 86'400.0;
constexpr double maxDriveGain = 1.0e6;
} // namespace sceneLimits

/// Empty if a Simulation can be built from the scene; else one sentence that names the place and what was
/// expected. Any thread.
std::string validate(const Scene& scene);

} // namespace physvib
