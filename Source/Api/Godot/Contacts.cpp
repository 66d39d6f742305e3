// SPDX-License-Identifier: MIT
// HapticWorld reads the contacts that Godot lists after the solver, and the slides of characters.
#include "Api/Godot/ImpactEstimate.h"
#include "Api/Godot/Worlds.h"
#include <algorithm>
#include <cmath>
#include <optional>

namespace physvib::godot {
namespace {
// Velocity, before the solver, of a body's point at `place`, m/s.
Vector velocityAt(const ObservedBody& body, const Vector& place) {
    const Vector spinVelocity = cross(body.spin, minus(place, body.centre));
    return {body.velocityBefore[0] + spinVelocity[0], body.velocityBefore[1] + spinVelocity[1],
            body.velocityBefore[2] + spinVelocity[2]};
}
Vector tangentialPart(const Vector& v, const Vector& normal) {
    const double along = dot(v, normal);
    return {v[0] - along * normal[0], v[1] - along * normal[1], v[2] - along * normal[2]};
}
// True if the normal points at the centre of mass within 1.1 degrees, as in contacts of balls.
bool goesThroughCentre(const ObservedBody& body, const Vector& place, const Vector& normal) {
    const Vector arm = minus(place, body.centre), sideways = tangentialPart(arm, normal);
    return body.isRigid && dot(sideways, sideways) < 4e-4 * dot(arm, arm);
}
// Index 0 to 5 of the axis direction nearest to the normal, which distinguishes floor and wall of one body.
int sideIndex(const Vector& normal) {
    const auto largest = std::ranges::max_element(normal, {}, [](double x) { return std::abs(x); });
    return 2 * static_cast<int>(largest - normal.begin()) + (*largest < 0.0 ? 1 : 0);
}
} // namespace

// A sleeping body keeps its list of contacts, even with bodies that were freed.
bool HapticWorld::doesOtherExist(const ObservedBody& body, int i) {
    const std::uint64_t id = body.state.contactOtherId(i);
    return id == 0 ? !body.state.isSleeping() : api.objectFromId(id) != nullptr;
}

double HapticWorld::readRestitution(std::uint64_t rid) {
    const auto [found, isNew] = restitutions.try_emplace(rid, 0.0);
    constexpr int bounce = 0; // PhysicsServer's BODY_PARAM_BOUNCE
    if (isNew) found->second = server().call("body_get_param", Variant(type::rid, &rid), bounce).real();
    return found->second;
}

void HapticWorld::reportTouches(ObservedBody& body) {
    Surface support{};
    double slowest = HUGE_VAL;
    for (int i = 0; i < body.state.contacts(); ++i) {
        if (involvesHapticBody(body, i) && doesOtherExist(body, i)) reportTouch(body, i);
        const Surface surface = contactSurface(body, i);
        if (const double speed = std::abs(approachSpeed(body, surface, i)); speed < slowest)
            support = surface, slowest = speed;
    }
    body.support = support;
}

// Approach speed without the gravity of this tick, m/s.
double HapticWorld::approachSpeed(const ObservedBody& body, const Surface& surface, int i) const {
    const Vector otherVelocity = toFieldVector(body.state.contactOtherVelocity(i));
    return dot(minus(velocityAt(body, surface.place), otherVelocity), surface.normal) -
           stepSeconds * dot(body.acceleration, surface.normal);
}

// Contacts of bodies without a HapticBody are ignored, because there may be thousands.
bool HapticWorld::involvesHapticBody(const ObservedBody& body, int i) const {
    if (body.hapticBody != nullptr) return true;
    const auto found = bodies.find(body.state.contactOtherId(i));
    return found != bodies.end() && found->second.hapticBody != nullptr;
}

// The other body of contact i; null if that body lists the pair too. If it is not rigid or is new, it moves
// with the velocity that Godot gives for the contact point.
ObservedBody* HapticWorld::otherBody(const ObservedBody& body, int i, const Vector& place) {
    const std::uint64_t id = body.state.contactOtherId(i);
    const auto found = bodies.find(id);
    if (found != bodies.end() && found->second.state && id < body.id && found->second.state.contacts() > 0)
        return nullptr;
    return addOther(id, body.state.contactRid(i), toFieldVector(body.state.contactOtherVelocity(i)), place);
}

ObservedBody* HapticWorld::addOther(std::uint64_t id, std::uint64_t rid, const Vector& velocity,
                                    const Vector& place) {
    const std::size_t oldCount = bodies.size();
    ObservedBody* found = findOrAdd(id, rid, nullptr);
    const bool isNew = bodies.size() != oldCount;
    if (found == nullptr || (!isNew && found->isRigid)) return found;
    const Vector none{};
    found->velocityBefore = velocity;
    found->centre = place;
    reportIfError(physvib_world_move_in_space(world, found->number, place.data(),
                                              found->velocityBefore.data(), none.data(), nullptr));
    if (found->isRigid)
        reportSolvedVelocity(*found);
    else
        reportIfError(
            physvib_world_moved_in_space(world, found->number, found->velocityBefore.data(), none.data()));
    return found;
}

// Jolt also lists near contacts. They count if reached in this tick and if the solver has slowed the bodies.
bool HapticWorld::reachesSurface(const ObservedBody& body, const ObservedBody& other,
                                 const Surface& surface) const {
    if (!(surface.gapMetres > 0.0)) return true;
    const Vector velocity = velocityAt(body, surface.place), otherVelocity = velocityAt(other, surface.place);
    return surface.gapMetres <= stepSeconds * dot(minus(velocity, otherVelocity), surface.normal);
}

Surface HapticWorld::contactSurface(const ObservedBody& body, int i) const {
    const Vector place = toField(body.state.contactPosition(i)),
                 otherPlace = toField(body.state.contactOtherPosition(i));
    Vector normal = toFieldVector(body.state.contactNormal(i));
    const double length = std::sqrt(dot(normal, normal));
    for (double& part : normal) part /= -length;
    return {place, otherPlace, normal, dot(minus(otherPlace, place), normal), length > 0.0};
}

// The surface of contact i, or the plane on which the body rolls or lands: an edge that does not rise above
// the plane, as between tiles, is no obstacle although Jolt's normal points at it, unless the solver stops
// the body, as at the foot of a ramp. For a ball this is uncertain: `supportSpeed` is its speed to the plane.
Surface HapticWorld::surfaceAcrossSeams(const ObservedBody& body, const ObservedBody& other, int i,
                                        std::optional<double>& supportSpeed) const {
    constexpr double maxEdgeMetres = 0.005;
    const Surface listed = contactSurface(body, i);
    if (goesThroughCentre(other, listed.place, listed.normal)) return listed;
    const bool isRound = goesThroughCentre(body, listed.place, listed.normal);
    const double minAlignment = isRound ? 0.0 : 0.5; // a box's lower corners touch walls at floor height
    Surface found = listed;
    double slowest = approachSpeed(body, listed, i);
    // The body rolls, or the solver stops it at this contact.
    const bool isListed = isRound ? slowest < 0.05 : lostSpeed(body, listed.normal) > 0.5 * slowest;
    for (int j = isRound ? -1 : 0; !isListed && j < body.state.contacts(); ++j) { // -1: of the last tick
        Surface support = j < 0 ? body.support : contactSurface(body, j);
        const double height = dot(minus(listed.otherPlace, support.otherPlace), support.normal),
                     alignment = dot(listed.normal, support.normal);
        const bool isNear = std::abs(height) < maxEdgeMetres || (isRound && alignment > 0.9);
        if (!support.hasNormal || !isNear || !(alignment > minAlignment) || alignment > 0.9999) continue;
        if (j < 0) { // the ball rolls over the edge
            const Vector arm = minus(listed.place, body.centre);
            for (std::size_t k = 0; k < 3; ++k)
                support.place[k] = body.centre[k] + std::sqrt(dot(arm, arm)) * support.normal[k];
            support.otherPlace = listed.otherPlace, support.gapMetres = listed.gapMetres;
        }
        // Contacts at two places of the same body are solved together.
        const bool isSeparate = j < 0 || body.state.contactRid(j) != body.state.contactRid(i);
        const double maxShare = !isRound ? 0.5 : isSeparate ? 0.9 : 0.1;
        if (const double speed = approachSpeed(body, support, std::max(0, j)); speed < maxShare * slowest) {
            found = support, slowest = speed;
            if (isRound) supportSpeed = j < 0 ? 0.0 : std::max(0.0, speed);
        }
    }
    return supportSpeed ? listed : found;
}

// Speed along a normal that the solver has removed, without the gravity of this tick, m/s.
double HapticWorld::lostSpeed(const ObservedBody& body, const Vector& normal) const {
    return -dot(body.velocityChange, normal) - stepSeconds * dot(body.acceleration, normal);
}

// At an edge or a flat ramp, the impact of a ball is the speed that the solver removes beyond `supportSpeed`
// (m/s). If approach speed remains, because Jolt brakes early, the contact is deferred to the next tick.
void HapticWorld::reportOrDefer(const ObservedBody& body, const ObservedBody& other, physvib_contact contact,
                                const Vector& normal, double supportSpeed) {
    const auto isSame = [&](const PendingContact& p) { return p.a == body.id && p.b == other.id; };
    const double approach = contact.approach_m_per_s,
                 pushSpeed = lostSpeed(body, normal) - lostSpeed(other, normal) - supportSpeed;
    if (std::ranges::any_of(previousContacts, isSame) || pushSpeed < 0.1 * std::abs(approach)) return;
    const double otherMassKg = other.description.mass_kg, massKg = body.description.mass_kg;
    contact.effective_mass_kg = otherMassKg > 0.0 ? massKg * otherMassKg / (massKg + otherMassKg) : massKg;
    contact.restitution = 0.0, contact.point_id = 6, contact.approach_m_per_s = pushSpeed;
    const PendingContact pending{body.id, other.id, normal, contact, approach - pushSpeed};
    if (const auto same = std::ranges::find_if(pendingContacts, isSame); same != pendingContacts.end()) {
        if (same->contact.approach_m_per_s < pushSpeed) *same = pending;
    } else if (approach > 1.1 * pushSpeed) {
        pendingContacts.push_back(pending);
    } else {
        reportIfError(physvib_world_touch(world, &contact));
    }
}

void HapticWorld::resolvePending() {
    constexpr int maxTicks = 3;
    previousContacts.swap(pendingContacts);
    pendingContacts.clear();
    for (PendingContact& pending : previousContacts) {
        const auto a = bodies.find(pending.a), b = bodies.find(pending.b);
        if (a == bodies.end() || b == bodies.end()) continue;
        double& speed = pending.contact.approach_m_per_s;
        const double pushSpeed = lostSpeed(a->second, pending.normal) - lostSpeed(b->second, pending.normal);
        speed += std::max(0.0, pushSpeed);
        pending.contact.fraction = std::max(-1.0, pending.contact.fraction - 1.0); // it was a tick earlier
        pending.remainingSpeed -= pushSpeed;
        if (pushSpeed > 0.1 * speed && pending.remainingSpeed > 0.1 * speed && ++pending.ticks < maxTicks)
            pendingContacts.push_back(pending);
        else
            reportIfError(physvib_world_touch(world, &pending.contact));
    }
}

void HapticWorld::reportTouch(const ObservedBody& body, int i) {
    const BodyState& state = body.state;
    const ObservedBody* other = otherBody(body, i, toField(state.contactOtherPosition(i)));
    if (other == nullptr) return;
    std::optional<double> supportSpeed;
    const Surface surface = surfaceAcrossSeams(body, *other, i, supportSpeed);
    const auto& [place, otherPlace, normal, gapMetres, hasNormal] = surface;
    const double speedBefore = dot(body.velocityBefore, normal);
    const bool isPushed = std::abs(dot(body.velocityChange, normal)) > 1e-3 * std::abs(speedBefore) + 1e-4;
    if (!hasNormal || (gapMetres > 0.0 && !isPushed)) return;
    bool doesReach = reachesSurface(body, *other, surface);
    for (int j = 0; !doesReach && j < state.contacts(); ++j) // other corners of a box that lands
        doesReach = state.contactOtherId(j) == state.contactOtherId(i) &&
                    reachesSurface(body, *other, contactSurface(body, j));
    if (!doesReach) return;
    const Vector velocity = velocityAt(body, place), otherVelocity = velocityAt(*other, place);
    const ImpactEstimate impact =
        estimateImpact(dot(minus(velocity, otherVelocity), normal), gapMetres,
                       dot(minus(body.acceleration, other->acceleration), normal), stepSeconds);
    const double bounce = readRestitution(body.rid) + readRestitution(state.contactRid(i));
    physvib_contact contact = makeContact(body, *other, place, normal);
    contact.restitution = std::clamp(bounce, 0.0, 1.0);
    contact.approach_m_per_s = impact.approachMetresPerSecond, contact.fraction = impact.fraction;
    contact.gap_m = gapMetres;
    // The contact point moves with the centre of a round body, otherwise with the corner of this body.
    const bool isRound = goesThroughCentre(body, place, normal),
               isOtherRound = goesThroughCentre(*other, place, normal);
    const Vector point = isRound ? body.velocityBefore : isOtherRound ? other->velocityBefore : velocity;
    const Vector slipA = tangentialPart(minus(point, velocity), normal),
                 slipB = tangentialPart(minus(point, otherVelocity), normal);
    const Vector slip = dot(slipA, slipA) > dot(slipB, slipB) ? slipA : slipB; // of the grains
    const double speed = std::max(1e-9, std::sqrt(dot(slip, slip)));
    contact.along_a_m_per_s = dot(slipA, slip) / speed, contact.along_b_m_per_s = dot(slipB, slip) / speed;
    contact.is_soft = PHYSVIB_SOFT; // speed gives the impact; the solver's push is a load
    if (other->isCharacter) contact.effective_mass_kg = body.description.mass_kg; // Godot does not push it
    contact.point_id = isRound || isOtherRound ? sideIndex(normal) : PHYSVIB_POINT_BY_PLACE;
    if (supportSpeed) return reportOrDefer(body, *other, contact, normal, *supportSpeed);
    reportIfError(physvib_world_touch(world, &contact));
}

// Reports what a CharacterBody hit in its last move_and_slide(), at the velocity that its script wants.
void HapticWorld::reportSlides(ObservedBody& body) {
    const Vector position = toField(body.object.call("get_global_position").vector());
    const Vector tickTravel = body.hasLastPosition ? minus(position, body.lastPosition) : Vector{};
    body.hasLastPosition = true;
    const int count = static_cast<int>(body.object.call("get_slide_collision_count").integer());
    double elapsedShare = 0.0; // of the tick
    for (int i = 0; i < count; ++i) {
        const Variant hit = body.object.call("get_slide_collision", i);
        const Vector travel = toFieldVector(hit.call("get_travel").vector());
        const Vector ahead = toFieldVector(hit.call("get_remainder").vector());
        const double travelled = std::sqrt(dot(travel, travel)), remaining = std::sqrt(dot(ahead, ahead));
        elapsedShare += (1.0 - elapsedShare) * (travelled > 0.0 ? travelled / (travelled + remaining) : 0.0);
        if (i == 0)
            for (std::size_t k = 0; k < 3; ++k) body.velocityBefore[k] = (travel[k] + ahead[k]) / stepSeconds;
        const Vector place = toField(hit.call("get_position").vector());
        const Vector hitNormal = toFieldVector(hit.call("get_normal").vector()); // towards the character
        const double length = std::sqrt(dot(hitNormal, hitNormal));
        const auto id = static_cast<std::uint64_t>(hit.call("get_collider_id").integer());
        const std::uint64_t rid = hit.call("get_collider_rid").rid();
        const ObservedBody* other =
            length > 0.0 ? addOther(id, rid, toFieldVector(hit.call("get_collider_velocity").vector()), place)
                         : nullptr;
        if (other == nullptr) continue;
        const Vector normal{-hitNormal[0] / length, -hitNormal[1] / length, -hitNormal[2] / length}, none{};
        reportIfError(physvib_world_move_in_space(world, body.number, place.data(),
                                                  body.velocityBefore.data(), none.data(), nullptr));
        physvib_contact contact = makeContact(body, *other, place, normal);
        const double approach = dot(minus(body.velocityBefore, other->velocityBefore), normal);
        const double twoTickTravel = dot(tickTravel, normal) + dot(body.lastTravel, normal) -
                                     2.0 * stepSeconds * dot(other->velocityBefore, normal);
        // A body that only presses came no nearer in two ticks, whatever velocity its script sets.
        contact.approach_m_per_s = twoTickTravel > 0.25 * stepSeconds * approach ? approach : 0.0;
        contact.fraction = elapsedShare, contact.point_id = PHYSVIB_POINT_NONE;
        contact.is_soft = PHYSVIB_SOFT;
        contact.effective_mass_kg = other->isRigid && other->description.mass_kg > 0.0
                                        ? other->description.mass_kg
                                        : body.description.mass_kg;
        reportIfError(physvib_world_touch(world, &contact));
        for (std::size_t k = 0; k < 3; ++k) // the character slides along the surface
            body.velocityBefore[k] -= std::max(0.0, approach) * normal[k];
    }
    body.lastPosition = position, body.lastTravel = tickTravel;
}

} // namespace physvib::godot
