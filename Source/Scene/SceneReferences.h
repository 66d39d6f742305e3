// SPDX-License-Identifier: MIT
// Checks of a scene that compare its parts with each other; part of validate().
#pragma once
#include "Scene/Scene.h"
#include <string>

namespace physvib {

/// Names of bodies and joints, and references to them in joints and the script with its times. Fields and
/// totals must be in range. Returns the first error, or empty. Any thread.
std::string checkReferences(const Scene& scene);

/// Every fixture that may become a haptic source has what it needs: a mass for Eq. 5.4, and the sounds that
/// its voice may play. References must be valid. Returns the first error, or empty. Any thread.
std::string checkCameras(const Scene& scene);

} // namespace physvib
