// SPDX-License-Identifier: MIT
// A contact as physvib wants it. Any thread.
#pragma once
#include "Api/Godot/Binding.h"
#include "Api/Godot/Worlds.h"
#include <physvib/physvib.h>

namespace physvib::godot {
/// At a place of the field, along a unit normal from `a` to `b`; the rest is the caller's.
inline physvib_contact contactOf(const Watched& a, const Watched& b, const Vector& at, const Vector& normal) {
    physvib_contact contact;
    physvib_contact_init(&contact, sizeof contact);
    contact.a = a.number, contact.b = b.number;
    contact.x_m = at[0], contact.y_m = at[1], contact.z_m = at[2];
    contact.normal_x = normal[0], contact.normal_y = normal[1], contact.normal_z = normal[2];
    contact.point_id = PHYSVIB_POINT_BY_PLACE;
    return contact;
}

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Reports an error of physvib.h to Godot. Its main thread.
inline void checkWorld(int code) {
    if (code < 0) report(std::string("HapticWorld: ") + physvib_error());
}

} // namespace physvib::godot
