// SPDX-License-Identifier: MIT
// Contact points on faces after the engine's solver, and how they move along both surfaces: four points at a
// time on processors with vectors of floats.
#pragma once
#include "Contacts/Vectors.h"
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace physvib {

/// A corner or disc on a face, with its bodies' motions. Fixtures are slots of the FixtureTable.
struct FacePoint {
    struct Mover {
        Vector2 velocity, centre; ///< of the body's centre of mass, world
    };
    FaceTouch touch;
    Mover face, other;
    float faceRadiansPerSecond = 0.0F, otherRadiansPerSecond = 0.0F;
    float normalNewtonSeconds = 0.0F;
    bool isFaceOfB = false;   ///< the face belongs to b
    bool isDiscRough = false; ///< the other is a rough disc, so its path is computed
    std::int32_t a = 0, b = 0;
    std::uint64_t pairsKey = 0;
    std::uint64_t feature = 0; ///< identifies the point within the pair; the same from step to step
};
// FaceColumns reads a point as floats, so their places are fixed
static_assert(sizeof(FaceTouch) == 16 * sizeof(float) && offsetof(FacePoint, face) == sizeof(FaceTouch));
static_assert(offsetof(FacePoint, isFaceOfB) == 27 * sizeof(float));

/// Transposes points: reads group `group` of four floats of faceLanes consecutive points into a to d, with
/// one point per lane. Processors without vectors of floats have one lane.
#if defined(__SSE2__) || defined(__ARM_NEON)
constexpr std::size_t faceLanes = 4;
using FloatLanes = float __attribute__((vector_size(faceLanes * sizeof(float))));
inline float laneOf(FloatLanes lanes, std::size_t lane) noexcept { return lanes[lane]; }

struct FaceColumns {
    FloatLanes a, b, c, d;
    [[gnu::always_inline]] FaceColumns(const FacePoint* rows, std::size_t group) noexcept {
        const auto row = [rows, group](std::size_t i) {
            FloatLanes quad;
            std::memcpy(&quad, reinterpret_cast<const char*>(rows + i) + group * sizeof quad, sizeof quad);
            return quad;
        };
        const FloatLanes r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
        const FloatLanes low01 = __builtin_shufflevector(r0, r1, 0, 4, 1, 5),
                         high01 = __builtin_shufflevector(r0, r1, 2, 6, 3, 7),
                         low23 = __builtin_shufflevector(r2, r3, 0, 4, 1, 5),
                         high23 = __builtin_shufflevector(r2, r3, 2, 6, 3, 7);
        a = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
        b = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
        c = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
        d = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
    }
};
#else
constexpr std::size_t faceLanes = 1;
using FloatLanes = float;
inline float laneOf(FloatLanes lanes, std::size_t) noexcept { return lanes; }

struct FaceColumns {
    FloatLanes a, b, c, d;
    FaceColumns(const FacePoint* row, std::size_t group) noexcept {
        std::memcpy(this, reinterpret_cast<const char*>(row) + group * sizeof *this, sizeof *this);
    }
};
#endif

/// How faceLanes points move: all members have one value per point.
struct FaceMotion {
    struct Vector {
        FloatLanes x, y;
    };
    Vector point;                               ///< between the surfaces, m, world
    Vector pointVelocity;                       ///< m/s, of the contact point itself
    FloatLanes faceMetres, faceMetresPerSecond; ///< along the face: the place in its frame, m, and m/s
    FloatLanes slipMetresPerSecond;             ///< of one surface relative to the other, m/s

    /// Each lane computes as for a single point, in the same order, so the bits are the same.
    [[gnu::always_inline]] explicit FaceMotion(const FacePoint* rows) noexcept {
        const FaceColumns touch0{rows, 0}, touch1{rows, 1}, touch2{rows, 2}, touch3{rows, 3},
            motion0{rows, 4}, motion1{rows, 5}, spins{rows, 6};
        const Rotation face{touch0.c, touch0.d}, other{touch1.c, touch1.d};
        const Vector origin{touch0.a, touch0.b}, faceCentre{motion0.c, motion0.d},
            otherCentre{motion1.c, motion1.d}, faceVelocity{motion0.a, motion0.b},
            otherVelocity{motion1.a, motion1.b};
        const Vector normal = face.turned({touch2.a, touch2.b}), tangent{normal.y, -normal.x},
                     corner = sum(other.turned({touch3.a, touch3.b}), {touch1.a, touch1.b}),
                     onFace = sum(face.turned({touch2.c, touch2.d}), origin),
                     upper = sum(corner, scaled(touch3.c - dot(difference(corner, onFace), normal), normal)),
                     lower = difference(corner, scaled(touch3.d, normal)), pointSum = sum(upper, lower);
        point = {0.5F * pointSum.x, 0.5F * pointSum.y};
        const Vector otherCornerVelocity = velocity(otherVelocity, spins.b, otherCentre, corner),
                     faceCornerVelocity = velocity(faceVelocity, spins.a, faceCentre, corner);
        pointVelocity = difference(otherCornerVelocity, scaled(touch3.d, crossed(spins.a, normal)));
        faceMetres = dot(face.turnedBack(difference(corner, origin)), face.turnedBack(tangent));
        faceMetresPerSecond = dot(difference(otherCornerVelocity, faceCornerVelocity), tangent);
        slipMetresPerSecond = dot(difference(velocity(otherVelocity, spins.b, otherCentre, point),
                                             velocity(faceVelocity, spins.a, faceCentre, point)),
                                  tangent);
    }

private:
    struct Rotation {
        FloatLanes sine, cosine;
        [[gnu::always_inline]] Vector turned(Vector v) const noexcept {
            return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y};
        }
        [[gnu::always_inline]] Vector turnedBack(Vector v) const noexcept {
            return {cosine * v.x + sine * v.y, -sine * v.x + cosine * v.y};
        }
    };
    [[gnu::always_inline]] static Vector sum(Vector a, Vector b) noexcept { return {a.x + b.x, a.y + b.y}; }
    [[gnu::always_inline]] static Vector difference(Vector a, Vector b) noexcept {
        return {a.x - b.x, a.y - b.y};
    }
    [[gnu::always_inline]] static Vector scaled(FloatLanes s, Vector v) noexcept {
        return {s * v.x, s * v.y};
    }
    [[gnu::always_inline]] static FloatLanes dot(Vector a, Vector b) noexcept {
        return a.x * b.x + a.y * b.y;
    }
    /// Velocity that a spin (rad/s) gives the end of an arm (m).
    [[gnu::always_inline]] static Vector crossed(FloatLanes spin, Vector arm) noexcept {
        return {-spin * arm.y, spin * arm.x};
    }
    [[gnu::always_inline]] static Vector velocity(Vector centreVelocity, FloatLanes spin, Vector centre,
                                                  Vector position) noexcept {
        return sum(centreVelocity, crossed(spin, difference(position, centre)));
    }
};

} // namespace physvib
