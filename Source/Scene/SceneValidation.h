// SPDX-License-Identifier: MIT
// Validates a scene before a world is built from it, and warns of sizes that Box2D simulates badly.
#pragma once
#include "Scene/Scene.h"
#include <string>
#include <vector>

namespace physvib {
/// Empty if a Simulation can be built from the scene; else one line that names the field, as scene files
/// spell it, and what was expected. Any thread.
std::string validate(const Scene& scene);

/// Warnings about dynamic bodies of a valid scene outside of the 0.1 to 10 m of Box2D. Any thread.
std::vector<std::string> sceneWarnings(const Scene& scene);

} // namespace physvib
