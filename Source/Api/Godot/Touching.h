// SPDX-License-Identifier: MIT
// A contact as physvib wants it. Any thread.
#pragma once

#include "Api/Godot/Worlds.h"

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

} // namespace physvib::godot
