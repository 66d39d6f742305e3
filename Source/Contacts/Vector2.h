// SPDX-License-Identifier: MIT
// A vector in the plane, in the single precision that 2D physics engines compute with, and a body's motion
// there.
#pragma once
#include "Contacts/Vector3.h"
#include <cmath>

namespace physvib {

/// A place (m), velocity (m/s), impulse (N s) and so on, as the variable's name says. Any thread.
struct Vector2 {
    float x = 0.0F, y = 0.0F;

    friend Vector2 operator+(Vector2 a, Vector2 b) noexcept { return {a.x + b.x, a.y + b.y}; }
    friend Vector2 operator-(Vector2 a, Vector2 b) noexcept { return {a.x - b.x, a.y - b.y}; }
    friend Vector2 operator-(Vector2 a) noexcept { return {-a.x, -a.y}; }
    friend Vector2 operator*(float s, Vector2 a) noexcept { return {s * a.x, s * a.y}; }
    friend double dot(Vector2 a, Vector2 b) noexcept { return static_cast<double>(a.x * b.x + a.y * b.y); }
    Vector2& operator+=(Vector2 other) noexcept { return *this = *this + other; }

    operator Vector3() const noexcept { return {x, y, 0.0F}; } ///< The same in space.

    float lengthSquared() const noexcept { return x * x + y * y; }
    float length() const noexcept { return std::sqrt(lengthSquared()); }

    /// The vector rotated by 90 degrees counter-clockwise.
    Vector2 turnedLeft() const noexcept { return {-y, x}; }
};

/// The part of a vector in space that lies in the plane. Any thread.
inline Vector2 inPlane(Vector3 of) noexcept { return {of.x, of.y}; }

/// Velocity of a body.
struct BodyMotion {
    Vector2 metresPerSecond;
    float radiansPerSecond = 0.0F; ///< counter-clockwise
};

} // namespace physvib
