// SPDX-License-Identifier: MIT
// What contacts have pushed, from the velocities before and after an engine's solver: for engines that do not
// tell it.
#pragma once
#include "Contacts/FedBodies.h"
#include "Contacts/IntegerMap.h"
#include "Contacts/Vector2.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// The impulses along the normals, none of them pulling, that together change the bodies' momentum as it was
/// changed (least kinetic energy of what is left over, by projected Gauss-Seidel). Friction and joints are
/// not known: what they change is laid to the contacts as far as it goes along their normals. A body between
/// two others has what comes in and what goes out, so a row hands on, and a landing on what is supported is
/// that of the whole. M only; allocates only when it outgrows what it has had.
class MomentumImpulses {
public:
    void clear();
    /// A point of two bodies whose velocities are known (FedBodies::hasAfter): its number, from 0 on.
    std::size_t add(const FedBodies& bodies, std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal);
    void solve();
    double newtonSeconds(std::size_t point) const { return points_[point].newtonSeconds; }

private:
    static constexpr std::int32_t none = IntegerMap::none;
    struct Body {
        double perKg, perInertia;
        double x = 0.0, y = 0.0, spin = 0.0; // what the impulses found so far have changed, m/s and rad/s
    };
    struct Point {
        std::int32_t a, b;             // bodies, or none: nothing moves it
        double nx, ny, leverA, leverB; // m
        double change;                 // m/s by which the surfaces have been kept from nearing each other
        double perNewtonSecond, newtonSeconds;
    };
    std::int32_t know(const FedBodies& bodies, std::int32_t id);
    double found(const Point& point) const;
    void push(const Point& point, double newtonSeconds);

    std::vector<Body> bodies_;
    IntegerMap bodyOf_; // by FedBodies' name
    std::vector<Point> points_;
};

} // namespace physvib
