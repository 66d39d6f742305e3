// SPDX-License-Identifier: MIT
// The thesis' first example and study 2 (5.1.5, 5.3): nine objects in a box that somebody shakes and tilts.
#pragma once
#include "Physics/Scene.h"

namespace physvib {

/// The scene "shake-the-box": cameras on the four walls, whose materials tell which wall was hit. Any thread.
Scene shakeTheBox();

} // namespace physvib
