// SPDX-License-Identifier: MIT
// HapticWorld reads the contacts that Godot lists after the solver, and the slides of characters.
#include "Api/Godot/Meeting.h"
#include "Api/Godot/Worlds.h"
#include <algorithm>
#include <cmath>
#include <optional>

namespace physvib::godot {
namespace {
// Velocity, before the solver, of a body's point at `place`, m/s.
Vector velocityAt(const Watched& body, const Vector& place) {
    const Vector turn = cross(body.spin, minus(place, body.centre));
    return {body.before[0] + turn[0], body.before[1] + turn[1], body.before[2] + turn[2]};
}
Vector across(const Vector& v, const Vector& normal) {
    const double along = dot(v, normal);
    return {v[0] - along * normal[0], v[1] - along * normal[1], v[2] - along * normal[2]};
}
// True if a normal points at the centre of mass, as in contacts of balls.
bool goesThroughCentre(const Watched& body, const Vector& at, const Vector& normal) {
    const Vector arm = minus(at, body.centre), beside = across(arm, normal);
    return body.isRigid && dot(beside, beside) < 4e-4 * dot(arm, arm);
}
// Index 0 to 5 of the axis direction nearest to the normal; tells floor and wall of one body apart.
int sideOf(const Vector& normal) {
    const auto longest = std::ranges::max_element(normal, {}, [](double x) { return std::abs(x); });
    return 2 * static_cast<int>(longest - normal.begin()) + (*longest < 0.0 ? 1 : 0);
}
} // namespace

// A sleeping body keeps its list of contacts, even with bodies that were freed.
bool HapticWorld::isOtherThere(const Watched& each, int i) {
    const std::uint64_t id = each.state.contactObject(i);
    return id == 0 ? !each.state.sleeps() : api.instanceFromId(id) != nullptr;
}

double HapticWorld::bounceOf(std::uint64_t rid) {
    const auto [found, isNew] = bounces.try_emplace(rid, 0.0);
    constexpr int bounce = 0; // PhysicsServer's BODY_PARAM_BOUNCE
    if (isNew) found->second = server().call("body_get_param", Value(type::rid, &rid), bounce).real();
    return found->second;
}

void HapticWorld::touchAll(Watched& each) {
    Surface under{};
    double slowest = HUGE_VAL;
    for (int i = 0; i < each.state.contacts(); ++i) {
        if (isOfInterest(each, i) && isOtherThere(each, i)) touch(each, i);
        const Surface its = surfaceOf(each, i);
        if (const double speed = std::abs(approach(each, its, i)); speed < slowest)
            under = its, slowest = speed;
    }
    each.under = under;
}

// Approach speed without the gravity of this tick, m/s.
double HapticWorld::approach(const Watched& each, const Surface& surface, int i) const {
    const Vector its = direction(each.state.contactOtherVelocity(i));
    return dot(minus(velocityAt(each, surface.at), its), surface.normal) -
           seconds * dot(each.pull, surface.normal);
}

// Contacts count only if one body has a HapticBody: others may be thousands.
bool HapticWorld::isOfInterest(const Watched& each, int i) const {
    if (each.values != nullptr) return true;
    const auto known = watched.find(each.state.contactObject(i));
    return known != watched.end() && known->second.values != nullptr;
}

// The other body of contact i; null if that body lists the pair too. If it is not rigid or is new, it moves
// with the velocity that Godot gives for the contact point.
Watched* HapticWorld::other(const Watched& each, int i, const Vector& place) {
    const std::uint64_t id = each.state.contactObject(i);
    const auto known = watched.find(id);
    if (known != watched.end() && known->second.state && id < each.id && known->second.state.contacts() > 0)
        return nullptr;
    return moving(id, each.state.contactBody(i), direction(each.state.contactOtherVelocity(i)), place);
}

Watched* HapticWorld::moving(std::uint64_t id, std::uint64_t rid, const Vector& velocity,
                             const Vector& place) {
    const std::size_t before = watched.size();
    Watched* found = watch(id, rid, nullptr);
    const bool isNew = watched.size() != before;
    if (found == nullptr || (!isNew && found->isRigid)) return found;
    const Vector none{};
    found->before = velocity;
    found->centre = place;
    checkWorld(physvib_world_move_in_space(world, found->number, place.data(), found->before.data(),
                                           none.data(), nullptr));
    if (found->isRigid)
        moveAfter(*found);
    else
        checkWorld(physvib_world_moved_in_space(world, found->number, found->before.data(), none.data()));
    return found;
}

// Jolt also lists near contacts. They count if reached in this tick and if the solver has slowed the bodies.
bool HapticWorld::getsThere(const Watched& each, const Watched& met, const Surface& surface) const {
    if (!(surface.gap > 0.0)) return true;
    const Vector own = velocityAt(each, surface.at), its = velocityAt(met, surface.at);
    return surface.gap <= seconds * dot(minus(own, its), surface.normal);
}

Surface HapticWorld::surfaceOf(const Watched& each, int i) const {
    const Vector at = place(each.state.contactPlace(i)), there = place(each.state.contactOtherPlace(i));
    Vector normal = direction(each.state.contactNormal(i));
    const double length = std::sqrt(dot(normal, normal));
    for (double& part : normal) part /= -length;
    return {at, there, normal, dot(minus(there, at), normal), length > 0.0};
}

// The surface of contact i, or the plane on which the body rolls or lands: an edge that does not rise above
// the plane, as between tiles, is no obstacle although Jolt's normal points at it, unless the solver stops
// the body, as at the foot of a ramp. If that is not sure, sets `doubt` to a ball's speed there.
Surface HapticWorld::overSeams(const Watched& each, const Watched& met, int i,
                               std::optional<double>& doubt) const {
    constexpr double outstanding = 0.005; // m
    const Surface own = surfaceOf(each, i);
    if (goesThroughCentre(met, own.at, own.normal)) return own;
    const bool isRound = goesThroughCentre(each, own.at, own.normal);
    const double least = isRound ? 0.0 : 0.5; // a box's lower corners touch walls at floor height
    Surface found = own;
    double slowest = approach(each, own, i);
    // It rolls, or the solver stops it there.
    const bool isPlain = isRound ? slowest < 0.05 : pushOf(each, own.normal) > 0.5 * slowest;
    for (int j = isRound ? -1 : 0; !isPlain && j < each.state.contacts(); ++j) { // -1: of the last tick
        Surface under = j < 0 ? each.under : surfaceOf(each, j);
        const double height = dot(minus(own.there, under.there), under.normal),
                     alike = dot(own.normal, under.normal);
        const bool isNear = std::abs(height) < outstanding || (isRound && alike > 0.9);
        if (!under.isOne || !isNear || !(alike > least) || alike > 0.9999) continue;
        if (j < 0) { // the ball rolls on over it
            const Vector arm = minus(own.at, each.centre);
            for (std::size_t k = 0; k < 3; ++k)
                under.at[k] = each.centre[k] + std::sqrt(dot(arm, arm)) * under.normal[k];
            under.there = own.there, under.gap = own.gap;
        }
        // Contacts at two places of the same body are solved together.
        const bool isAlone = j < 0 || each.state.contactBody(j) != each.state.contactBody(i);
        const double most = !isRound ? 0.5 : isAlone ? 0.9 : 0.1;
        if (const double its = approach(each, under, std::max(0, j)); its < most * slowest) {
            found = under, slowest = its;
            if (isRound) doubt = j < 0 ? 0.0 : std::max(0.0, its);
        }
    }
    return doubt ? own : found;
}

// Speed along a normal that the solver has removed, without the gravity of this tick, m/s.
double HapticWorld::pushOf(const Watched& each, const Vector& normal) const {
    return -dot(each.change, normal) - seconds * dot(each.pull, normal);
}

// At an edge or a flat ramp, the impact of a ball is the speed that the solver removes beyond the `known`
// one. If approach speed remains, since Jolt brakes early, the contact is deferred to the next tick.
void HapticWorld::strikeDoubtful(const Watched& each, const Watched& met, physvib_contact contact,
                                 const Vector& normal, double known) {
    const auto isSame = [&](const Doubt& of) { return of.a == each.id && of.b == met.id; };
    const double came = contact.approach_m_per_s, pushed = pushOf(each, normal) - pushOf(met, normal) - known;
    if (std::ranges::any_of(decided, isSame) || pushed < 0.1 * std::abs(came)) return;
    const double its = met.described.mass_kg, own = each.described.mass_kg;
    contact.effective_mass_kg = its > 0.0 ? own * its / (own + its) : own;
    contact.restitution = 0.0, contact.point_id = 6, contact.approach_m_per_s = pushed;
    const Doubt doubt{each.id, met.id, normal, contact, came - pushed};
    if (const auto same = std::ranges::find_if(doubts, isSame); same != doubts.end()) {
        if (same->contact.approach_m_per_s < pushed) *same = doubt;
    } else if (came > 1.1 * pushed) {
        doubts.push_back(doubt);
    } else {
        checkWorld(physvib_world_touch(world, &contact));
    }
}

void HapticWorld::decide() {
    constexpr int longest = 3; // ticks
    decided.swap(doubts);
    doubts.clear();
    for (Doubt& of : decided) {
        const auto each = watched.find(of.a), met = watched.find(of.b);
        if (each == watched.end() || met == watched.end()) continue;
        double& speed = of.contact.approach_m_per_s;
        const double pushed = pushOf(each->second, of.normal) - pushOf(met->second, of.normal);
        speed += std::max(0.0, pushed);
        of.contact.fraction = std::max(-1.0, of.contact.fraction - 1.0); // the impact was a tick earlier
        of.left -= pushed;
        if (pushed > 0.1 * speed && of.left > 0.1 * speed && ++of.ticks < longest)
            doubts.push_back(of);
        else
            checkWorld(physvib_world_touch(world, &of.contact));
    }
}

void HapticWorld::touch(const Watched& each, int i) {
    const BodyState& state = each.state;
    const Watched* met = other(each, i, place(state.contactOtherPlace(i)));
    if (met == nullptr) return;
    std::optional<double> doubt;
    const Surface surface = overSeams(each, *met, i, doubt);
    const auto& [at, there, normal, gap, isOne] = surface;
    const double before = dot(each.before, normal);
    const bool isPushed = std::abs(dot(each.change, normal)) > 1e-3 * std::abs(before) + 1e-4;
    if (!isOne || (gap > 0.0 && !isPushed)) return;
    bool isThere = getsThere(each, *met, surface);
    for (int j = 0; !isThere && j < state.contacts(); ++j) // a box that lands turns, and its other corners
                                                           // follow
        isThere =
            state.contactObject(j) == state.contactObject(i) && getsThere(each, *met, surfaceOf(each, j));
    if (!isThere) return;
    const Vector own = velocityAt(each, at), its = velocityAt(*met, at);
    const Meeting meeting =
        meetingOf(dot(minus(own, its), normal), gap, dot(minus(each.pull, met->pull), normal), seconds);
    const double bounce = bounceOf(each.rid) + bounceOf(state.contactBody(i));
    physvib_contact contact = contactOf(each, *met, at, normal);
    contact.restitution = std::clamp(bounce, 0.0, 1.0);
    contact.approach_m_per_s = meeting.approachMetresPerSecond, contact.fraction = meeting.fraction;
    contact.gap_m = gap;
    // The contact point moves with the centre of a round body, otherwise with the corner of this body.
    const bool isRound = goesThroughCentre(each, at, normal),
               isOtherRound = goesThroughCentre(*met, at, normal);
    const Vector point = isRound ? each.before : isOtherRound ? met->before : own;
    const Vector overOwn = across(minus(point, own), normal), overIts = across(minus(point, its), normal);
    const Vector way = dot(overOwn, overOwn) > dot(overIts, overIts) ? overOwn : overIts; // of the grains
    const double speed = std::max(1e-9, std::sqrt(dot(way, way)));
    contact.along_a_m_per_s = dot(overOwn, way) / speed, contact.along_b_m_per_s = dot(overIts, way) / speed;
    contact.is_soft = PHYSVIB_SOFT; // speed gives the impact; the solver's push is a load
    if (met->slides) contact.effective_mass_kg = each.described.mass_kg; // Godot does not push it
    contact.point_id = isRound || isOtherRound ? sideOf(normal) : PHYSVIB_POINT_BY_PLACE;
    if (doubt) return strikeDoubtful(each, *met, contact, normal, *doubt);
    checkWorld(physvib_world_touch(world, &contact));
}

// Reports what a CharacterBody hit in its last move_and_slide(), at the velocity that its script wants.
void HapticWorld::slideAll(Watched& each) {
    const Vector now = place(each.body.call("get_global_position").vector());
    const Vector step = each.wasAt ? minus(now, each.at) : Vector{}; // a new body has no travel
    each.wasAt = true;
    const int count = static_cast<int>(each.body.call("get_slide_collision_count").whole());
    double moved = 0.0; // share of the tick
    for (int i = 0; i < count; ++i) {
        const Value hit = each.body.call("get_slide_collision", i);
        const Vector travel = direction(hit.call("get_travel").vector());
        const Vector rest = direction(hit.call("get_remainder").vector());
        const double gone = std::sqrt(dot(travel, travel)), left = std::sqrt(dot(rest, rest));
        moved += (1.0 - moved) * (gone > 0.0 ? gone / (gone + left) : 0.0);
        if (i == 0)
            for (std::size_t k = 0; k < 3; ++k) each.before[k] = (travel[k] + rest[k]) / seconds;
        const Vector at = place(hit.call("get_position").vector());
        const Vector along = direction(hit.call("get_normal").vector()); // towards the character
        const double length = std::sqrt(dot(along, along));
        const auto id = static_cast<std::uint64_t>(hit.call("get_collider_id").whole());
        const std::uint64_t rid = hit.call("get_collider_rid").rid();
        const Watched* met = length > 0.0
                                 ? moving(id, rid, direction(hit.call("get_collider_velocity").vector()), at)
                                 : nullptr;
        if (met == nullptr) continue;
        const Vector normal{-along[0] / length, -along[1] / length, -along[2] / length}, none{};
        checkWorld(physvib_world_move_in_space(world, each.number, at.data(), each.before.data(), none.data(),
                                               nullptr));
        physvib_contact contact = contactOf(each, *met, at, normal);
        const double approach = dot(minus(each.before, met->before), normal);
        const double came =
            dot(step, normal) + dot(each.step, normal) - 2.0 * seconds * dot(met->before, normal);
        // A body that only presses came no nearer in two ticks, whatever velocity its script sets.
        contact.approach_m_per_s = came > 0.25 * seconds * approach ? approach : 0.0;
        contact.fraction = moved, contact.point_id = PHYSVIB_POINT_NONE;
        contact.is_soft = PHYSVIB_SOFT;
        contact.effective_mass_kg =
            met->isRigid && met->described.mass_kg > 0.0 ? met->described.mass_kg : each.described.mass_kg;
        checkWorld(physvib_world_touch(world, &contact));
        for (std::size_t k = 0; k < 3; ++k) // it slides on along the surface
            each.before[k] -= std::max(0.0, approach) * normal[k];
    }
    each.at = now, each.step = step;
}

} // namespace physvib::godot
