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
// About z alone in the plane, whose y goes down.
Vector HapticWorld::turn(const Vector& spin) const { return isSpace ? spin : Vector{0.0, 0.0, -spin[2]}; }
Vector HapticWorld::place(const Vector& v) const { return direction(minus(v, corner)); }

void HapticWorld::beginStep() {
    if (isOpen) finishStep();
    if (!isFirst()) return forget();
    if (isStale) configure();
    seconds = self().call("get_physics_process_delta_time").real();
    if (world == nullptr || !(seconds > 0.0)) return;
    watchAll();
    double gravity = 0.0;
    for (auto& [id, each] : watched) {
        if (each.slides)
            each.gravity = direction(each.body.call("get_gravity").vector());
        else
            each.gravity = each.state ? direction(each.state.gravity()) : Vector{};
        gravity = std::max(gravity, std::sqrt(dot(each.gravity, each.gravity)));
    }
    checkWorld(physvib_world_begin_step(world, seconds, gravity));
    isOpen = true;
    for (auto& [id, each] : watched)
        if (each.state) moveBefore(each);
    std::vector<Watched*> sliding; // which may meet bodies that are new here
    for (auto& [id, each] : watched)
        if (each.slides && each.values != nullptr) sliding.push_back(&each);
    for (Watched* each : sliding) slideAll(*each);
}

void HapticWorld::moveBefore(Watched& each) {
    const BodyState& state = each.state;
    each.centre = place(state.centre());
    const bool falls = each.described.mass_kg > 0.0 && !state.sleeps();
    const Vector velocity = direction(state.velocity());
    each.pull = falls ? each.gravity : Vector{};
    const double keeps = std::max(0.0, 1.0 - seconds * state.linearDamp());
    const double keepsSpin = std::max(0.0, 1.0 - seconds * state.angularDamp());
    for (std::size_t i = 0; i < 3; ++i) each.before[i] = velocity[i] * keeps + each.pull[i] * seconds;
    each.spin = turn(state.spin());
    for (double& rate : each.spin) rate *= keepsSpin;
    std::array<double, 6> inverse = state.inverseInertia();
    for (double& each6 : inverse) each6 /= unit * unit;
    checkWorld(physvib_world_move_in_space(world, each.number, each.centre.data(), each.before.data(),
                                           each.spin.data(), inverse.data()));
}

void HapticWorld::finishStep() {
    if (!isOpen) return;
    isOpen = false;
    bounces.clear();
    std::vector<const Watched*> rigid; // contacts add bodies, and leave these where they are
    for (auto& [id, each] : watched) {
        each.isMet = false;
        each.state = {};
        if (!each.isRigid || !isThere(each)) continue;
        moveAfter(each);
        if (each.state) rigid.push_back(&each);
    }
    for (const Watched* each : rigid) touchAll(*each);
    checkWorld(physvib_world_end_step(world));
    emitAll();
}

void HapticWorld::moveAfter(Watched& each) {
    each.state = BodyState::of(each.rid, isSpace);
    if (!each.state) return;
    const Vector velocity = direction(each.state.velocity());
    const Vector spin = turn(each.state.spin());
    each.change = minus(velocity, each.before);
    checkWorld(physvib_world_moved_in_space(world, each.number, velocity.data(), spin.data()));
}

} // namespace physvib::godot
