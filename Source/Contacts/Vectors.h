// SPDX-License-Identifier: MIT
// Vectors of floats, as physics engines have them; motions and frames of bodies; points on faces; inertia.
#pragma once
#include <array>
#include <cmath>

namespace physvib {

/// A vector in space: a place (m), velocity (m/s), impulse (N s) and so on, as the variable's name says. What
/// lies in the plane has z = 0, and every sum below then has the bits of the same sum of Vector2: z adds
/// exact zeros, last. Any thread.
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
inline double lengthOf(Vector3 v) noexcept {
    const auto x = static_cast<double>(v.x), y = static_cast<double>(v.y), z = static_cast<double>(v.z);
    return std::sqrt(x * x + y * y + z * z);
}

/// Velocity of a body in space.
struct SpaceMotion {
    Vector3 metresPerSecond;
    Vector3 radiansPerSecond; ///< about each axis, counter-clockwise seen from its end
};

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
inline Vector2 inPlane(Vector3 v) noexcept { return {v.x, v.y}; }

/// Place and rotation of a body's frame.
struct Frame {
    Vector2 origin;
    float sine = 0.0F, cosine = 1.0F; ///< of the angle, counter-clockwise

    Vector2 turned(Vector2 v) const noexcept {
        return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y};
    }
    Vector2 turnedBack(Vector2 v) const noexcept {
        return {cosine * v.x + sine * v.y, -sine * v.x + cosine * v.y};
    }
    Vector2 toWorld(Vector2 v) const noexcept { return turned(v) + origin; } ///< from the frame to the world
};

/// A corner or disc of one body on a face of another.
struct FaceTouch {
    Frame face, other;
    Vector2 normal, onFace; ///< in the face's frame: out of it, and a point on it
    Vector2 corner;         ///< in the other body's frame
    float faceRadius = 0.0F, otherRadius = 0.0F;

    /// The point between the surfaces, world.
    Vector2 point() const noexcept {
        const Vector2 outward = face.turned(normal), tip = other.toWorld(corner);
        const auto height = static_cast<float>(dot(tip - face.toWorld(onFace), outward));
        return 0.5F * ((tip + (faceRadius - height) * outward) + (tip - otherRadius * outward));
    }
};

/// Velocity of a body.
struct BodyMotion {
    Vector2 metresPerSecond;
    float radiansPerSecond = 0.0F; ///< counter-clockwise
};

/// The inverse of the moments of inertia about the centre of mass, 1/(kg m^2): a symmetric matrix in the
/// world's axes. All 0: nothing turns the body. Any thread.
struct InverseInertia {
    double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;

    /// The same value about every axis, as a ball has it.
    static InverseInertia ofBall(double perKgSquareMetre) noexcept {
        return {perKgSquareMetre, perKgSquareMetre, perKgSquareMetre, 0.0, 0.0, 0.0};
    }

    /// Change of spin, rad/s, by `newtonSeconds` that act with this lever (arm x direction), m.
    [[gnu::always_inline]] std::array<double, 3> spin(double newtonSeconds, Vector3 lever) const noexcept {
        const auto x = static_cast<double>(lever.x), y = static_cast<double>(lever.y),
                   z = static_cast<double>(lever.z), s = newtonSeconds;
        return {s * xx * x + s * xy * y + s * xz * z, s * xy * x + s * yy * y + s * yz * z,
                s * xz * x + s * yz * y + s * zz * z};
    }

    /// Change of speed at one lever by 1 N s at the other, 1/kg.
    double coupling(Vector3 u, Vector3 v) const noexcept {
        const auto product = [](float a, float b) { return static_cast<double>(a) * static_cast<double>(b); };
        return product(u.x, v.x) * xx + product(u.y, v.y) * yy + product(u.z, v.z) * zz +
               (product(u.x, v.y) + product(u.y, v.x)) * xy + (product(u.x, v.z) + product(u.z, v.x)) * xz +
               (product(u.y, v.z) + product(u.z, v.y)) * yz;
    }

    /// True if the matrix is positive semi-definite, as that of every body is; false for NaN. With another
    /// matrix an impulse could push a body towards what struck it. A singular one, of a body that turns about
    /// one or two axes only, is valid.
    bool isValid() const noexcept {
        constexpr double max = 1.0e18;
        for (const double moment : {xx, yy, zz})
            if (!(moment >= 0.0 && moment <= max)) return false;
        // no product of inertia is larger than the root of its two moments' product; engines round
        const auto isWithin = [](double product, double momentA, double momentB) {
            return std::abs(product) <= 1.0001 * std::sqrt(momentA * momentB);
        };
        return isWithin(xy, xx, yy) && isWithin(xz, xx, zz) && isWithin(yz, yy, zz) && isSemiDefinite();
    }

private:
    /// The last pivot of Cholesky's factors, where each axis has a moment: with those of the pairs above, it
    /// tells a positive semi-definite matrix. Scaled by the moments, since those of a rod differ a lot.
    bool isSemiDefinite() const noexcept {
        if (!(xx > 0.0 && yy > 0.0 && zz > 0.0)) return true; // the pairs are all there is
        const double a = xy / std::sqrt(xx * yy), b = xz / std::sqrt(xx * zz), c = yz / std::sqrt(yy * zz);
        return 1.0 + 2.0 * a * b * c - a * a - b * b - c * c >= -1e-3;
    }
};

} // namespace physvib
