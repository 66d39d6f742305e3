// SPDX-License-Identifier: MIT
// The checks of a scene that compare one part of it with another; parts of validate().
#pragma once
#include "Scene/Scene.h"
#include <string>

namespace physvib {

/// Names of bodies and joints, and what names them: joints, and the script with its times. Every field must
/// be in range, and the totals too. The first fault, or empty. Any thread.
std::string checkReferences(const Scene& scene);

/// Whatever ever has a camera has what it needs: a mass for Eq. 5.4, and the sounds that its voice may take.
/// References must be good. The first fault, or empty. Any thread.
std::string checkCameras(const Scene& scene);

} // namespace physvib
