// SPDX-License-Identifier: MIT
// Contacts of a tick, as Godot's state of a body lists them after the solver.
#include "Api/Godot/Meeting.h"
#include "Api/Godot/Vectors.h"
#include "Api/Godot/Worlds.h"

#include <algorithm>
#include <cmath>

namespace physvib::godot {

namespace {
// Velocity before the solver of the point of a body that is at `place`.
Vector velocityAt(const Watched& body, const Vector& place) {
    const Vector turn = cross(body.spin, minus(place, body.centre));
    return {body.before[0] + turn[0], body.before[1] + turn[1], body.before[2] + turn[2]};
}
Vector across(const Vector& v, const Vector& normal) {
    const double along = dot(v, normal);
    return {v[0] - along * normal[0], v[1] - along * normal[1], v[2] - along * normal[2]};
}
// As contacts of balls do.
bool goesThroughCentre(const Watched& body, const Vector& at, const Vector& normal) {
    const Vector arm = minus(at, body.centre), beside = across(arm, normal);
    return body.isRigid && dot(beside, beside) < 4e-4 * dot(arm, arm);
}
physvib_contact contactOf(const Watched& a, const Watched& b, const Vector& at, const Vector& normal) {
    physvib_contact contact;
    physvib_contact_init(&contact, sizeof contact);
    contact.a = a.number, contact.b = b.number;
    contact.x_m = at[0], contact.y_m = at[1], contact.z_m = at[2];
    contact.normal_x = normal[0], contact.normal_y = normal[1], contact.normal_z = normal[2];
    contact.point_id = PHYSVIB_POINT_BY_PLACE;
    return contact;
}
} // namespace

double HapticWorld::bounceOf(const Value& rid) const {
    constexpr int bounce = 0; // PhysicsServer's BODY_PARAM_BOUNCE
    return server().call("body_get_param", rid, bounce).real();
}

void HapticWorld::touchAll(const Watched& each) {
    if (each.state.object() == nullptr) return;
    const int count = static_cast<int>(each.state.call("get_contact_count").whole());
    for (int i = 0; i < count; ++i) touch(each, i);
}

// A body without velocities of its own, or that is met for the first time, moves as Godot says of the point.
Watched* HapticWorld::other(const Watched& each, int i, const Vector& place) {
    const auto id = static_cast<std::uint64_t>(each.state.call("get_contact_collider_id", i).whole());
    if (api.instanceFromId(id) == nullptr) return nullptr;
    const auto known = watched.find(id);
    const bool isNew = known == watched.end();
    if (!isNew && known->second.state.object() != nullptr && id < each.id &&
        known->second.state.call("get_contact_count").isTrue())
        return nullptr; // that body lists this pair too
    return moving(id, direction(each.state.call("get_contact_collider_velocity_at_position", i).vector()),
                  place);
}

Watched* HapticWorld::moving(std::uint64_t id, const Vector& velocity, const Vector& place) {
    const bool isNew = !watched.contains(id);
    Watched* found = watch(id, nullptr);
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

void HapticWorld::touch(const Watched& each, int i) {
    const Value& state = each.state;
    const Vector at = place(state.call("get_contact_local_position", i).vector());
    const Vector there = place(state.call("get_contact_collider_position", i).vector());
    Vector normal = direction(state.call("get_contact_local_normal", i).vector()); // away from the other
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0.0)) return;
    for (double& part : normal) part /= -length;
    const double gap = dot(minus(there, at), normal), before = dot(each.before, normal);
    const bool isPushed = std::abs(dot(each.change, normal)) > 1e-3 * std::abs(before) + 1e-4;
    if (gap > 0.0 && !isPushed) return; // Jolt lists what comes near before it touches
    const Watched* met = other(each, i, there);
    if (met == nullptr) return;
    const Vector own = velocityAt(each, at), its = velocityAt(*met, at);
    const Meeting meeting =
        meetingOf(dot(minus(own, its), normal), gap, dot(minus(each.pull, met->pull), normal), seconds);
    const double bounce =
        bounceOf(each.body.call("get_rid")) + bounceOf(state.call("get_contact_collider", i));
    physvib_contact contact = contactOf(each, *met, at, normal);
    contact.restitution = std::clamp(bounce, 0.0, 1.0);
    contact.approach_m_per_s = meeting.approachMetresPerSecond, contact.fraction = meeting.fraction;
    contact.gap_m = gap;
    // The point goes with a round body's centre, or with the corner of what moves.
    const bool isRound = goesThroughCentre(each, at, normal),
               isOtherRound = goesThroughCentre(*met, at, normal);
    const Vector point = isRound ? each.before : isOtherRound ? met->before : own;
    const Vector overOwn = across(minus(point, own), normal), overIts = across(minus(point, its), normal);
    const Vector way = dot(overOwn, overOwn) > dot(overIts, overIts) ? overOwn : overIts; // of the grains
    const double speed = std::max(1e-9, std::sqrt(dot(way, way)));
    contact.along_a_m_per_s = dot(overOwn, way) / speed, contact.along_b_m_per_s = dot(overIts, way) / speed;
    contact.is_soft = PHYSVIB_SOFT; // an impact is as hard as its speed; what the solver pushed is a load
    if (met->slides) contact.effective_mass_kg = each.told.mass_kg; // which Godot does not push
    contact.point_id = isRound || isOtherRound ? 0 : PHYSVIB_POINT_BY_PLACE;
    checkWorld(physvib_world_touch(world, &contact));
}

// What a CharacterBody struck in its last move_and_slide(): straight on within the tick, as its script wants.
void HapticWorld::slideAll(Watched& each) {
    const int count = static_cast<int>(each.body.call("get_slide_collision_count").whole());
    double moved = 0.0; // of the tick
    const Vector now = place(each.body.call("get_global_position").vector()), step = minus(now, each.at);
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
        Watched* met = length > 0.0 && api.instanceFromId(id) != nullptr
                           ? moving(id, direction(hit.call("get_collider_velocity").vector()), at)
                           : nullptr;
        if (met == nullptr) continue;
        const Vector normal{-along[0] / length, -along[1] / length, -along[2] / length}, none{};
        checkWorld(physvib_world_move_in_space(world, each.number, at.data(), each.before.data(), none.data(),
                                               nullptr));
        physvib_contact contact = contactOf(each, *met, at, normal);
        const double approach = dot(minus(each.before, met->before), normal);
        const double came =
            dot(step, normal) + dot(each.step, normal) - 2.0 * seconds * dot(met->before, normal);
        // What only presses came no nearer in two ticks, whatever velocity its script sets.
        contact.approach_m_per_s = came > 0.25 * seconds * approach ? approach : 0.0;
        contact.fraction = moved, contact.point_id = PHYSVIB_POINT_NONE;
        contact.is_soft = PHYSVIB_SOFT;
        contact.effective_mass_kg =
            met->isRigid && met->told.mass_kg > 0.0 ? met->told.mass_kg : each.told.mass_kg;
        checkWorld(physvib_world_touch(world, &contact));
        for (std::size_t k = 0; k < 3; ++k) // it slides on
            each.before[k] -= std::max(0.0, approach) * normal[k];
    }
    each.at = now, each.step = step;
}

} // namespace physvib::godot
