// SPDX-License-Identifier: MIT
// A contact as physvib wants it. Any thread.
#pragma once
#include "Api/Godot/Binding.h"
#include "Api/Godot/Worlds.h"
#include <algorithm>
#include <cmath>
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

// Sums of vectors, and errors of a world. Any thread but checkWorld(), which is for Godot's main thread.

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Reports an error of physvib.h to Godot.
inline void checkWorld(int code) {
    if (code < 0) report(std::string("HapticWorld: ") + physvib_error());
}

// When and how fast two surfaces met. Any thread.

struct Meeting {
    double approachMetresPerSecond;
    double fraction; ///< in steps after the moment at which the engine looked
};

/// Godot adds a step's gravity to velocities, looks where bodies overlap, and moves them straight on. So its
/// places lie on a parabola whose speed at the look is half a step's gravity below the `speed` of the solver,
/// and the surfaces met where that parabola crosses the other surface: before the look if they overlap
/// (`gap` below 0), after it if Jolt saw them coming. `pull`: acceleration of one towards the other.
inline Meeting meetingOf(double speed, double gap, double pull, double seconds) {
    const double looked = speed - 0.5 * pull * seconds;
    if (!(looked > 0.0)) return {speed, 0.0}; // rests, or parts
    const double squared = looked * looked + 2.0 * pull * gap;
    const double met = squared > 0.0 ? std::sqrt(squared) : looked;
    return {met, std::clamp(2.0 * gap / (looked + met) / seconds, -1.0, 1.0)};
}

} // namespace physvib::godot
