// SPDX-License-Identifier: MIT
// Sums of vectors, and errors of a world. Any thread but checkWorld(), which is for Godot's main thread.
#pragma once

#include "Api/Godot/Binding.h"

#include <physvib/physvib.h>

namespace physvib::godot {

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Reports an error of physvib.h to Godot.
inline void checkWorld(int code) {
    if (code < 0) report(std::string("HapticWorld: ") + physvib_error());
}

} // namespace physvib::godot
