// SPDX-License-Identifier: MIT
// A tick: beginStep() reads motions after the last script and before the solver, finishStep() reads motions
// and contacts after it. Nothing is written to Godot's physics.
#include "Api/Godot/Worlds.h"
#include "Api/Godot/Vectors.h"

#include <algorithm>
#include <cmath>

namespace physvib::godot {

Value HapticWorld::server() const { return singleton(isSpace ? "PhysicsServer3D" : "PhysicsServer2D"); }

Vector HapticWorld::direction(const Vector& v) const {
    return {v[0] * unit, isSpace ? v[1] * unit : -v[1] * unit, v[2] * unit};
}
Vector HapticWorld::place(const Vector& v) const { return direction(minus(v, corner)); }

void HapticWorld::beginStep() {
    seconds = self().call("get_physics_process_delta_time").real();
    if (world == nullptr || seconds <= 0.0) return;
    if (isOpen) finishStep();
    if (isStale) configure();
    watchAll();
    double gravity = 0.0;
    for (auto& [id, each] : watched) {
        if (!each.isRigid && !each.slides) continue;
        const Vector pull = direction(
            (each.isRigid ? each.state.member("total_gravity") : each.body.call("get_gravity")).vector());
        gravity = std::max(gravity, std::sqrt(dot(pull, pull)));
    }
    checkWorld(physvib_world_begin_step(world, seconds, gravity));
    isOpen = true;
    for (auto& [id, each] : watched)
        if (each.isRigid) moveBefore(each);
    std::vector<std::uint64_t> sliding; // which may meet bodies that are new here
    for (const auto& [id, each] : watched)
        if (each.slides && each.values != nullptr) sliding.push_back(id);
    for (const std::uint64_t id : sliding) slideAll(watched.at(id));
}

// Bodies that were freed go, those of new HapticBody nodes come, masses are as they are now.
void HapticWorld::watchAll() {
    for (auto& [id, each] : watched) each.values = nullptr;
    for (const HapticBody* values : hapticBodies())
        if (values->bodyId() != 0 && api.instanceFromId(values->bodyId()) != nullptr)
            watch(values->bodyId(), values);
    for (auto it = watched.begin(); it != watched.end();) {
        const bool isThere =
            api.instanceFromId(it->first) != nullptr && it->second.body.call("is_inside_tree").isTrue();
        if (isThere) {
            describe(it->second);
            ++it;
            continue;
        }
        physvib_world_remove_body(world, it->second.number);
        objects.erase(it->second.number);
        it = watched.erase(it);
    }
}

Watched* HapticWorld::watch(std::uint64_t id, const HapticBody* values) {
    if (const auto known = watched.find(id); known != watched.end()) {
        if (values != nullptr) known->second.values = values;
        return &known->second;
    }
    const Value body(api.instanceFromId(id));
    if (!body.call("is_class", isSpace ? "CollisionObject3D" : "CollisionObject2D").isTrue()) return nullptr;
    const bool isRigid = body.call("is_class", isSpace ? "RigidBody3D" : "RigidBody2D").isTrue();
    const bool slides = body.call("is_class", isSpace ? "CharacterBody3D" : "CharacterBody2D").isTrue();
    Watched& added = watched.emplace(id, Watched{id, next++, values, isRigid, slides, body}).first->second;
    objects[added.number] = id;
    describe(added);
    return &added;
}

void HapticWorld::describe(Watched& each) {
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    if (each.values != nullptr && !each.values->describe(body)) each.values = nullptr;
    each.state = each.isRigid ? server().call("body_get_direct_state", each.body.call("get_rid")) : Value();
    const double inverse = each.state.object() == nullptr ? 0.0 : each.state.member("inverse_mass").real();
    body.mass_kg = inverse > 0.0 ? 1.0 / inverse : each.slides ? body.static_mass_kg : 0.0;
    each.told = body;
    checkWorld(physvib_world_set_body(world, each.number, &body));
}

void HapticWorld::moveBefore(Watched& each) {
    const Value& state = each.state;
    if (state.object() == nullptr) return;
    const Vector origin = state.member("transform").member("origin").vector();
    const Vector offset = state.member("center_of_mass").vector();
    each.centre = place({origin[0] + offset[0], origin[1] + offset[1], origin[2] + offset[2]});
    const bool falls = each.told.mass_kg > 0.0 && !state.member("sleeping").isTrue();
    const Vector velocity = direction(state.member("linear_velocity").vector());
    each.pull = falls ? direction(state.member("total_gravity").vector()) : Vector{};
    const double keeps = std::max(0.0, 1.0 - seconds * state.member("total_linear_damp").real());
    const double keepsSpin = std::max(0.0, 1.0 - seconds * state.member("total_angular_damp").real());
    for (std::size_t i = 0; i < 3; ++i) each.before[i] = velocity[i] * keeps + each.pull[i] * seconds;
    each.spin = state.member("angular_velocity").vector();
    std::array<double, 6> inverse{};
    if (isSpace) {
        const Value tensor = state.member("inverse_inertia_tensor");
        const Vector x = tensor.member("x").vector(), y = tensor.member("y").vector(),
                     z = tensor.member("z").vector();
        inverse = {x[0], y[1], z[2], x[1], x[2], y[2]};
    } else {
        each.spin = {0.0, 0.0, -state.member("angular_velocity").real()};
        inverse[2] = state.member("inverse_inertia").real() / (unit * unit);
    }
    for (double& rate : each.spin) rate *= keepsSpin;
    checkWorld(physvib_world_move_in_space(world, each.number, each.centre.data(), each.before.data(),
                                           each.spin.data(), inverse.data()));
}

void HapticWorld::finishStep() {
    if (!isOpen) return;
    isOpen = false;
    for (auto& [id, each] : watched)
        if (each.isRigid && api.instanceFromId(id) != nullptr) moveAfter(each);
    std::vector<std::uint64_t> rigid;
    for (const auto& [id, each] : watched)
        if (each.isRigid && api.instanceFromId(id) != nullptr) rigid.push_back(id);
    for (const std::uint64_t id : rigid) touchAll(watched.at(id));
    checkWorld(physvib_world_end_step(world));
    emitAll();
}

void HapticWorld::moveAfter(Watched& each) {
    each.state = server().call("body_get_direct_state", each.body.call("get_rid"));
    if (each.state.object() == nullptr) return;
    const Vector velocity = direction(each.state.member("linear_velocity").vector());
    Vector spin = each.state.member("angular_velocity").vector();
    if (!isSpace) spin = {0.0, 0.0, -each.state.member("angular_velocity").real()};
    each.change = minus(velocity, each.before);
    checkWorld(physvib_world_moved_in_space(world, each.number, velocity.data(), spin.data()));
}

} // namespace physvib::godot
