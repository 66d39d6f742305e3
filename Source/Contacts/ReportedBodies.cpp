// SPDX-License-Identifier: MIT
// Stores the bodies that a caller reports, and computes approach speed and effective mass of two bodies at a
// point.
#include "Contacts/ReportedBodies.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace physvib {

namespace {

Vector3 velocityAt(const SpaceMotion& motion, Vector3 arm) noexcept {
    return motion.metresPerSecond + cross(motion.radiansPerSecond, arm);
}

/// Speed across the normal that a spin gives a point: |(spin x arm) x normal|.
double slideOf(Vector3 spin, Vector3 arm, Vector3 normal) noexcept {
    const double about = dot(spin, normal), along = dot(arm, normal);
    const auto part = [=](float r, float w) {
        return static_cast<double>(r) * about - static_cast<double>(w) * along;
    };
    const double x = part(arm.x, spin.x), y = part(arm.y, spin.y), z = part(arm.z, spin.z);
    return std::sqrt(x * x + y * y + z * z);
}

} // namespace

void ReportedBodies::set(std::int32_t id, const FedBody& body) {
    std::int32_t slot = slots_.find(idOf(id));
    if (slot == IntegerMap::none) {
        slot = static_cast<std::int32_t>(bodies_.size());
        slots_.set(idOf(id), slot);
        bodies_.push_back({id, {}, {}, {}, {}});
    }
    Body& known = bodies_[static_cast<std::size_t>(slot)];
    forgetLargest(known);
    known.told = body;
    largestMassKg_ = std::max(largestMassKg_, body.massKg);
}

void ReportedBodies::move(std::int32_t id, Vector3 centre, const SpaceMotion& motion,
                          const std::optional<InverseInertia>& inverse) {
    Body& body = bodies_[static_cast<std::size_t>(slots_.find(idOf(id)))];
    body.centre = centre;
    body.motion = motion;
    body.inverse = inverse;
}

void ReportedBodies::moveAfter(std::int32_t id, const SpaceMotion& motion) {
    Body& body = bodies_[static_cast<std::size_t>(slots_.find(idOf(id)))];
    body.after = motion;
    body.afterAge = age_;
    isAnyAfter_ = true;
}

bool ReportedBodies::hasAfter(std::int32_t id) const {
    const Body& body = at(idOf(id));
    return !(body.told.massKg > 0.0) || body.afterAge == age_;
}

void ReportedBodies::remove(std::int32_t id) {
    const std::int32_t slot = slots_.find(idOf(id));
    Body& hole = bodies_[static_cast<std::size_t>(slot)];
    forgetLargest(hole);
    slots_.erase(idOf(id));
    if (&hole != &bodies_.back()) {
        hole = bodies_.back();
        slots_.set(idOf(hole.id), slot);
    }
    bodies_.pop_back();
}

void ReportedBodies::forgetLargest(const Body& body) noexcept {
    if (body.told.massKg > 0.0 && body.told.massKg >= largestMassKg_) isLargestKnown_ = false;
}

double ReportedBodies::largestMassKg() {
    if (!isLargestKnown_) {
        largestMassKg_ = 0.0;
        for (const Body& body : bodies_) largestMassKg_ = std::max(largestMassKg_, body.told.massKg);
        isLargestKnown_ = true;
    }
    return largestMassKg_;
}

double ReportedBodies::approach(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const {
    const Body &bodyA = at(idOf(a)), &bodyB = at(idOf(b));
    const Vector3 nearing =
        velocityAt(bodyA.motion, point - bodyA.centre) - velocityAt(bodyB.motion, point - bodyB.centre);
    return dot(nearing, normal);
}

double ReportedBodies::approachAfter(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const {
    const auto after = [&](const Body& body) { return body.told.massKg > 0.0 ? body.after : body.motion; };
    const Body &bodyA = at(idOf(a)), &bodyB = at(idOf(b));
    const Vector3 nearing =
        velocityAt(after(bodyA), point - bodyA.centre) - velocityAt(after(bodyB), point - bodyB.centre);
    return dot(nearing, normal);
}

double ReportedBodies::slide(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const {
    double sum = 0.0;
    for (const Body* body : {&at(idOf(a)), &at(idOf(b))})
        sum += lengthOf(cross(body->motion.metresPerSecond, normal)) +
               slideOf(body->motion.radiansPerSecond, point - body->centre, normal);
    return sum;
}

// Divides by the moment of inertia where that is known, instead of multiplying by its inverse: the last bit
// may differ.
double ReportedBodies::turning(const Body& body, Vector3 lever, Vector3 other) noexcept {
    if (body.inverse) return body.inverse->between(lever, other);
    if (!(body.told.inertiaKgSquareMetres > 0.0)) return 0.0;
    return InverseInertia::ofBall(1.0).between(lever, other) / body.told.inertiaKgSquareMetres;
}

InverseInertia ReportedBodies::inverseInertia(std::int32_t id) const {
    const Body& body = at(idOf(id));
    if (!(body.told.massKg > 0.0)) return {};
    if (body.inverse) return *body.inverse;
    const double told = body.told.inertiaKgSquareMetres;
    return InverseInertia::ofBall(told > 0.0 ? 1.0 / told : 0.0);
}

double ReportedBodies::coupling(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal,
                                Vector3 otherPoint, Vector3 otherNormal) const {
    double sum = 0.0;
    for (const Body* body : {&at(idOf(a)), &at(idOf(b))}) {
        if (!(body->told.massKg > 0.0)) continue;
        sum += dot(normal, otherNormal) / body->told.massKg;
        sum += turning(*body, cross(point - body->centre, normal),
                       cross(otherPoint - body->centre, otherNormal));
    }
    return sum;
}

double ReportedBodies::effectiveMassKg(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const {
    double perKg = 0.0;
    for (const Body* body : {&at(idOf(a)), &at(idOf(b))}) {
        if (!(body->told.massKg > 0.0)) continue;
        perKg += 1.0 / body->told.massKg;
        const Vector3 lever = cross(point - body->centre, normal);
        perKg += turning(*body, lever, lever);
    }
    return perKg > 0.0 ? 1.0 / perKg : std::numeric_limits<double>::infinity();
}

BodyFacts ReportedBodies::facts(std::uint64_t body) const {
    const FedBody& told = at(body).told;
    return {body, told.massKg, static_cast<float>(told.gravityScale), told.massKg > 0.0, true};
}

} // namespace physvib
