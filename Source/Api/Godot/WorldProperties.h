// SPDX-License-Identifier: MIT
// The places of a haptic world's properties in its table.
#pragma once

namespace physvib::godot {
enum WorldProperty {
    metresPerUnit,
    fieldCorner,
    fieldSize,
    fullScale,
    threshold,
    outputs,
    layout,
    actuators,
    levelDb,
    silent
};
} // namespace physvib::godot
