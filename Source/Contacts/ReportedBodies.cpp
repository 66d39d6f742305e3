// SPDX-License-Identifier: MIT
// Bodies that a caller reports, their approach speed and effective mass at a point, and reported slides.
#include "Contacts/ReportedContacts.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace physvib {
namespace {

Vector3 velocityAt(const SpaceMotion& motion, Vector3 arm) noexcept {
    return motion.metresPerSecond + cross(motion.radiansPerSecond, arm);
}

/// Speed across the normal that a spin gives a point: |(spin x arm) x normal|.
double slideSpeed(Vector3 spin, Vector3 arm, Vector3 normal) noexcept {
    const double spinAlong = dot(spin, normal), armAlong = dot(arm, normal);
    const auto part = [=](float r, float w) {
        return static_cast<double>(r) * spinAlong - static_cast<double>(w) * armAlong;
    };
    const double x = part(arm.x, spin.x), y = part(arm.y, spin.y), z = part(arm.z, spin.z);
    return std::sqrt(x * x + y * y + z * z);
}

} // namespace

void ReportedBodies::set(std::int32_t id, const FedBody& body, double inertiaMassKg) {
    std::int32_t slot = slots_.find(idOf(id));
    if (slot == IntegerMap::none) {
        slot = static_cast<std::int32_t>(bodies_.size());
        slots_.set(idOf(id), slot);
        bodies_.push_back({id, {}, {}, {}, {}});
    }
    Body& known = bodies_[static_cast<std::size_t>(slot)];
    invalidateLargestMass(known);
    known.reported = body;
    known.inertiaMassKg = inertiaMassKg;
    largestMassKg_ = std::max(largestMassKg_, body.massKg);
}

void ReportedBodies::move(std::int32_t id, Vector3 centre, const SpaceMotion& motion,
                          const std::optional<InverseInertia>& inverse) {
    Body& body = bodies_[static_cast<std::size_t>(slots_.find(idOf(id)))];
    body.centre = centre;
    body.motion = motion;
    body.inverse = inverse;
}

void ReportedBodies::setMotionAfter(std::int32_t id, const SpaceMotion& motion) {
    Body& body = bodies_[static_cast<std::size_t>(slots_.find(idOf(id)))];
    body.motionAfter = motion;
    body.motionAfterAge = age_;
    hasAnyMotionAfter_ = true;
}

bool ReportedBodies::hasMotionAfter(std::int32_t id) const {
    const Body& body = at(idOf(id));
    return !(body.reported.massKg > 0.0) || body.motionAfterAge == age_;
}

void ReportedBodies::remove(std::int32_t id) {
    const std::int32_t slot = slots_.find(idOf(id));
    Body& hole = bodies_[static_cast<std::size_t>(slot)];
    invalidateLargestMass(hole);
    slots_.erase(idOf(id));
    if (&hole != &bodies_.back()) {
        hole = bodies_.back();
        slots_.set(idOf(hole.id), slot);
    }
    bodies_.pop_back();
}

void ReportedBodies::invalidateLargestMass(const Body& body) noexcept {
    if (body.reported.massKg > 0.0 && body.reported.massKg >= largestMassKg_) isLargestKnown_ = false;
}

bool ReportedBodies::isFixedAtRest(std::int32_t id) const {
    const Body& body = at(idOf(id));
    return !(body.reported.massKg > 0.0) && lengthOf(body.motion.metresPerSecond) == 0.0 &&
           lengthOf(body.motion.radiansPerSecond) == 0.0;
}

double ReportedBodies::largestMassKg() {
    if (!isLargestKnown_) {
        largestMassKg_ = 0.0;
        for (const Body& body : bodies_) largestMassKg_ = std::max(largestMassKg_, body.reported.massKg);
        isLargestKnown_ = true;
    }
    return largestMassKg_;
}

double ReportedBodies::approach(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal,
                                bool isAfter) const {
    const auto velocity = [&](const Body& body) {
        const bool isSolved = isAfter && body.reported.massKg > 0.0;
        return velocityAt(isSolved ? body.motionAfter : body.motion, point - body.centre);
    };
    return dot(velocity(at(idOf(a))) - velocity(at(idOf(b))), normal);
}

double ReportedBodies::slide(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const {
    double sum = 0.0;
    for (const Body* body : {&at(idOf(a)), &at(idOf(b))})
        sum += lengthOf(cross(body->motion.metresPerSecond, normal)) +
               slideSpeed(body->motion.radiansPerSecond, point - body->centre, normal);
    return sum;
}

// Divides by the moment of inertia where that is known, instead of multiplying by its inverse: the last bit
// may differ.
double ReportedBodies::angularCoupling(const Body& body, Vector3 lever, Vector3 other) noexcept {
    if (body.inverse) return body.inverse->coupling(lever, other);
    if (!(body.reported.inertiaKgSquareMetres > 0.0)) return 0.0;
    return InverseInertia::ofBall(1.0).coupling(lever, other) / body.reported.inertiaKgSquareMetres;
}

InverseInertia ReportedBodies::inverseInertia(std::int32_t id) const {
    const Body& body = at(idOf(id));
    if (!(body.reported.massKg > 0.0)) return {};
    if (body.inverse) return *body.inverse;
    const double reported = body.reported.inertiaKgSquareMetres;
    return InverseInertia::ofBall(reported > 0.0 ? 1.0 / reported : 0.0);
}

double ReportedBodies::coupling(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal,
                                Vector3 otherPoint, Vector3 otherNormal) const {
    double sum = 0.0;
    for (const Body* body : {&at(idOf(a)), &at(idOf(b))}) {
        if (!(body->reported.massKg > 0.0)) continue;
        sum += dot(normal, otherNormal) / body->reported.massKg;
        sum += angularCoupling(*body, cross(point - body->centre, normal),
                               cross(otherPoint - body->centre, otherNormal));
    }
    return sum;
}

double ReportedBodies::effectiveMassKg(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal,
                                       Vector3 drag) const {
    double perKg = 0.0;
    for (const Body* body : {&at(idOf(a)), &at(idOf(b))}) {
        if (!(body->reported.massKg > 0.0)) continue;
        perKg += 1.0 / body->reported.massKg;
        const Vector3 lever = cross(point - body->centre, normal);
        perKg += angularCoupling(*body, cross(point - body->centre, normal + drag), lever);
    }
    return perKg > 0.0 ? 1.0 / perKg : std::numeric_limits<double>::infinity();
}

Vector3 ReportedBodies::limitedDrag(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal,
                                    Vector3 drag) const {
    const double length = lengthOf(drag);
    if (!(length > 1.0e-6)) return {};
    const Vector3 direction = static_cast<float>(1.0 / length) * drag;
    const double stopping =
        -coupling(a, b, point, direction, point, normal) / coupling(a, b, point, direction, point, direction);
    return stopping > 0.0 && stopping < length ? static_cast<float>(stopping) * direction : drag;
}

BodyFacts ReportedBodies::facts(std::uint64_t body) const {
    const FedBody& reported = at(body).reported;
    return {body, reported.massKg, static_cast<float>(reported.gravityScale), reported.massKg > 0.0, true};
}

void ReportedSlides::report(const ReportedSlide& reported) {
    const std::uint64_t key = pairKey(reported.a, reported.b);
    std::int32_t index = trackOf_.find(key);
    if (index == IntegerMap::none) {
        index = static_cast<std::int32_t>(tracks_.size());
        trackOf_.set(key, index);
        Track& added = tracks_.emplace_back();
        added.key = key;
        added.isNew = true;
        added.isReported = false;
        added.point.a = reported.a;
        added.point.b = reported.b;
    }
    Track& track = tracks_[static_cast<std::size_t>(index)];
    LastingPoint& point = track.point;
    if (!std::exchange(track.isReported, true)) point.normalNewtonSeconds = 0.0;
    point.normalNewtonSeconds += std::max(0.0, reported.newtonSeconds);
    point.point = reported.point;
    const bool isTurned = point.a != reported.a; // the fixtures were reported in the other order
    point.onA.metresPerSecond = isTurned ? reported.alongB : reported.alongA;
    point.onB.metresPerSecond = isTurned ? reported.alongA : reported.alongB;
}

void ReportedSlides::endStep(double seconds, LastingContacts& lasting) {
    for (std::size_t i = 0; i < tracks_.size();) {
        Track& track = tracks_[i];
        if (!std::exchange(track.isReported, false)) {
            drop(i);
            continue;
        }
        LastingPoint& point = track.point;
        for (SurfacePath* path : {&point.onA, &point.onB}) path->metres += path->metresPerSecond * seconds;
        point.slipMetresPerSecond = point.onA.metresPerSecond - point.onB.metresPerSecond;
        point.velocity = {};
        if (!std::exchange(track.isNew, false) && seconds > 0.0)
            point.velocity = static_cast<float>(1.0 / seconds) * (point.point - track.lastPoint);
        track.lastPoint = point.point;
        lasting.touch(point);
        ++i;
    }
}

void ReportedSlides::forget(std::int32_t slot) {
    for (std::size_t i = tracks_.size(); i-- > 0;)
        if (tracks_[i].point.a == slot || tracks_[i].point.b == slot) drop(i);
}

void ReportedSlides::drop(std::size_t track) {
    trackOf_.erase(tracks_[track].key);
    if (track + 1 < tracks_.size()) {
        tracks_[track] = tracks_.back();
        trackOf_.set(tracks_[track].key, static_cast<std::int32_t>(track));
    }
    tracks_.pop_back();
}

} // namespace physvib
