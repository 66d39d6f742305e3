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

// Checks of a scene that compare its parts with each other; part of validate().

/// Names of bodies and joints, and references to them in joints and the script with its times. Fields and
/// totals must be in range. Returns the first error, or empty. Any thread.
std::string checkReferences(const Scene& scene);

/// Every fixture that may become a haptic source has what it needs: a mass for Eq. 5.4, and the sounds that
/// its voice may play. References must be valid. Returns the first error, or empty. Any thread.
std::string checkCameras(const Scene& scene);

} // namespace physvib
