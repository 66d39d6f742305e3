// SPDX-License-Identifier: MIT
// The properties of a haptic world: their table, and their places in it.
#pragma once

#include "Api/Godot/Classes.h"

namespace physvib::godot {
enum WorldProperty {
    metresPerUnit,
    fieldCorner,
    fieldSize,
    fieldFromCamera,
    fullScale,
    threshold,
    physicsMaterials,
    outputs,
    layout,
    actuators,
    levelDb,
    silent,
    sessionFile
};
const std::vector<Property>& worldProperties(bool isSpace);
} // namespace physvib::godot
