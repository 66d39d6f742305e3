// SPDX-License-Identifier: MIT
// Estimates contact impulses from the bodies' velocities before and after the solver, for engines that do not
// report impulses.
#pragma once
#include "Contacts/IntegerMap.h"
#include "Contacts/InverseInertia.h"
#include "Contacts/ReportedBodies.h"
#include "Contacts/Vector3.h"
#include <array>
#include <cstdint>
#include <vector>

namespace physvib {

/// Finds the impulses along the normals, none of them pulling, that together explain the bodies' change of
/// momentum (least kinetic energy of the remainder, by projected Gauss-Seidel). Friction and joints are not
/// known; their effects are attributed to the contacts as far as they act along the normals. A body between
/// two others has the impulses on both sides, so a row transmits an impact, and a landing on a supported body
/// counts the whole. World thread (M) only; allocates only to grow.
class MomentumImpulses {
public:
    void clear();
    /// Adds a point of two bodies whose velocities are known (ReportedBodies::hasAfter). Returns its number,
    /// from 0 on.
    std::size_t add(const ReportedBodies& bodies, std::int32_t a, std::int32_t b, Vector3 point,
                    Vector3 normal);
    void solve();
    double newtonSeconds(std::size_t point) const { return points_[point].newtonSeconds; }

private:
    static constexpr std::int32_t none = IntegerMap::none;
    struct Body {
        double perKg;
        InverseInertia turning;
        // changes by the impulses found so far, m/s and rad/s
        std::array<double, 3> velocity{}, spin{};
    };
    struct Point {
        std::int32_t a, b;              // bodies, or none: immovable
        Vector3 normal, leverA, leverB; // m
        double change;                  // m/s by which the contact has reduced the approach speed
        double perNewtonSecond, newtonSeconds;
    };
    std::int32_t know(const ReportedBodies& bodies, std::int32_t id);
    bool isInPlane(const Point& point) const;
    // `inPlane` leaves out what is 0 there.
    template <bool inPlane>
    static double along(const Body& body, Vector3 normal, Vector3 lever) noexcept;
    template <bool inPlane>
    double found(const Point& point) const;
    template <bool inPlane>
    void push(const Point& point, double newtonSeconds);
    template <bool inPlane>
    void sweep();

    bool isInPlane_ = true; // all points: normals along x and y, spin about z alone
    std::vector<Body> bodies_;
    IntegerMap bodyOf_; // by ReportedBodies::idOf()
    std::vector<Point> points_;
};

} // namespace physvib
