// SPDX-License-Identifier: MIT
// A vector in space, in the single precision that physics engines compute with, and a body's motion there.
#pragma once
#include <cmath>

namespace physvib {

/// A place (m), velocity (m/s), impulse (N s) and so on, as the variable's name says. What lies in the plane
/// has z = 0, and every sum below then has the bits of the same sum of Vector2: z adds exact zeros, last. Any
/// thread.
struct Vector3 {
    float x = 0.0F, y = 0.0F, z = 0.0F;

    friend Vector3 operator+(Vector3 a, Vector3 b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector3 operator-(Vector3 a, Vector3 b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector3 operator-(Vector3 a) noexcept { return {-a.x, -a.y, -a.z}; }
    friend Vector3 operator*(float s, Vector3 a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
    friend double dot(Vector3 a, Vector3 b) noexcept {
        return static_cast<double>(a.x * b.x + a.y * b.y + a.z * b.z);
    }
    friend Vector3 cross(Vector3 a, Vector3 b) noexcept {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    Vector3& operator+=(Vector3 other) noexcept { return *this = *this + other; }

    float lengthSquared() const noexcept { return x * x + y * y + z * z; }
    float length() const noexcept { return std::sqrt(lengthSquared()); }
};

/// The length in double precision, in which the root of one component's square is that component. Any thread.
inline double lengthOf(Vector3 of) noexcept {
    const auto x = static_cast<double>(of.x), y = static_cast<double>(of.y), z = static_cast<double>(of.z);
    return std::sqrt(x * x + y * y + z * z);
}

/// Velocity of a body in space.
struct SpaceMotion {
    Vector3 metresPerSecond;
    Vector3 radiansPerSecond; ///< about each axis, counter-clockwise seen from its end
};

} // namespace physvib
