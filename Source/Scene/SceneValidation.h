// SPDX-License-Identifier: MIT
// Validates a scene before a world is built from it.
#pragma once
#include "Scene/Scene.h"
#include <string>
#include <vector>

namespace physvib {
/// Empty if a Simulation can be built from the scene; else one line that names the field, as scene files
/// spell it, and what was expected. Any thread.
std::string validate(const Scene& scene);

/// Warnings about a valid scene that is simulated badly: dynamic bodies outside of the 0.1 to 10 m that Box2D
/// is made for. Any thread.
std::vector<std::string> sceneWarnings(const Scene& scene);

} // namespace physvib
