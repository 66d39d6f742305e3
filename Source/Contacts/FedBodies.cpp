// SPDX-License-Identifier: MIT
// Stores the bodies that a caller reports, and computes approach speed and effective mass of two bodies at a
// point.
#include "Contacts/FedBodies.h"
#include <algorithm>
#include <limits>

namespace physvib {

namespace {

Vector2 velocityAt(const BodyMotion& motion, Vector2 arm) noexcept {
    return motion.metresPerSecond + motion.radiansPerSecond * arm.turnedLeft();
}

} // namespace

void FedBodies::set(std::int32_t id, const FedBody& body) {
    std::int32_t slot = slots_.find(nameOf(id));
    if (slot == IntegerMap::none) {
        slot = static_cast<std::int32_t>(bodies_.size());
        slots_.set(nameOf(id), slot);
        bodies_.push_back({id, {}, {}, {}, {}});
    }
    Body& known = bodies_[static_cast<std::size_t>(slot)];
    forgetLargest(known);
    known.told = body;
    largestMassKg_ = std::max(largestMassKg_, body.massKg);
}

void FedBodies::move(std::int32_t id, Vector2 centre, const BodyMotion& motion) {
    Body& body = bodies_[static_cast<std::size_t>(slots_.find(nameOf(id)))];
    body.centre = centre;
    body.motion = motion;
}

void FedBodies::moveAfter(std::int32_t id, const BodyMotion& motion) {
    Body& body = bodies_[static_cast<std::size_t>(slots_.find(nameOf(id)))];
    body.after = motion;
    body.afterAge = age_;
    isAnyAfter_ = true;
}

bool FedBodies::hasAfter(std::int32_t id) const {
    const Body& body = at(nameOf(id));
    return !(body.told.massKg > 0.0) || body.afterAge == age_;
}

void FedBodies::remove(std::int32_t id) {
    const std::int32_t slot = slots_.find(nameOf(id));
    Body& hole = bodies_[static_cast<std::size_t>(slot)];
    forgetLargest(hole);
    slots_.erase(nameOf(id));
    if (&hole != &bodies_.back()) {
        hole = bodies_.back();
        slots_.set(nameOf(hole.id), slot);
    }
    bodies_.pop_back();
}

void FedBodies::forgetLargest(const Body& body) noexcept {
    if (body.told.massKg > 0.0 && body.told.massKg >= largestMassKg_) isLargestKnown_ = false;
}

double FedBodies::largestMassKg() {
    if (!isLargestKnown_) {
        largestMassKg_ = 0.0;
        for (const Body& body : bodies_) largestMassKg_ = std::max(largestMassKg_, body.told.massKg);
        isLargestKnown_ = true;
    }
    return largestMassKg_;
}

double FedBodies::approach(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal) const {
    const Body &bodyA = at(nameOf(a)), &bodyB = at(nameOf(b));
    const Vector2 nearing =
        velocityAt(bodyA.motion, point - bodyA.centre) - velocityAt(bodyB.motion, point - bodyB.centre);
    return dot(nearing, normal);
}

double FedBodies::approachAfter(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal) const {
    const auto after = [&](const Body& body) { return body.told.massKg > 0.0 ? body.after : body.motion; };
    const Body &bodyA = at(nameOf(a)), &bodyB = at(nameOf(b));
    const Vector2 nearing =
        velocityAt(after(bodyA), point - bodyA.centre) - velocityAt(after(bodyB), point - bodyB.centre);
    return dot(nearing, normal);
}

double FedBodies::slide(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal) const {
    double sum = 0.0;
    for (const Body* body : {&at(nameOf(a)), &at(nameOf(b))})
        sum +=
            std::abs(dot(body->motion.metresPerSecond, normal.turnedLeft())) +
            std::abs(static_cast<double>(body->motion.radiansPerSecond) * dot(point - body->centre, normal));
    return sum;
}

double FedBodies::coupling(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal, Vector2 otherPoint,
                           Vector2 otherNormal) const {
    double sum = 0.0;
    for (const Body* body : {&at(nameOf(a)), &at(nameOf(b))}) {
        if (!(body->told.massKg > 0.0)) continue;
        sum += dot(normal, otherNormal) / body->told.massKg;
        if (!(body->told.inertiaKgSquareMetres > 0.0)) continue;
        const double lever = dot((point - body->centre).turnedLeft(), normal),
                     other = dot((otherPoint - body->centre).turnedLeft(), otherNormal);
        sum += lever * other / body->told.inertiaKgSquareMetres;
    }
    return sum;
}

double FedBodies::effectiveMassKg(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal) const {
    double perKg = 0.0;
    for (const Body* body : {&at(nameOf(a)), &at(nameOf(b))}) {
        if (!(body->told.massKg > 0.0)) continue;
        perKg += 1.0 / body->told.massKg;
        if (!(body->told.inertiaKgSquareMetres > 0.0)) continue;
        const double lever = dot((point - body->centre).turnedLeft(), normal);
        perKg += lever * lever / body->told.inertiaKgSquareMetres;
    }
    return perKg > 0.0 ? 1.0 / perKg : std::numeric_limits<double>::infinity();
}

BodyFacts FedBodies::facts(std::uint64_t body) const {
    const FedBody& told = at(body).told;
    return {body, told.massKg, static_cast<float>(told.gravityScale), told.massKg > 0.0, true};
}

} // namespace physvib
