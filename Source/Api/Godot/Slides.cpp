// SPDX-License-Identifier: MIT
// Contacts of a CharacterBody, as its move_and_slide() lists them.
#include "Api/Godot/Touching.h"
#include "Api/Godot/Vectors.h"
#include "Api/Godot/Worlds.h"

#include <algorithm>
#include <cmath>

namespace physvib::godot {

// What a CharacterBody struck in its last move_and_slide(): straight on within the tick, as its script wants.
void HapticWorld::slideAll(Watched& each) {
    const Vector now = place(each.body.call("get_global_position").vector());
    const Vector step = each.wasAt ? minus(now, each.at) : Vector{}; // new here, it came from nowhere
    each.wasAt = true;
    const int count = static_cast<int>(each.body.call("get_slide_collision_count").whole());
    double moved = 0.0; // of the tick
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
        // What only presses came no nearer in two ticks, whatever velocity its script sets.
        contact.approach_m_per_s = came > 0.25 * seconds * approach ? approach : 0.0;
        contact.fraction = moved, contact.point_id = PHYSVIB_POINT_NONE;
        contact.is_soft = PHYSVIB_SOFT;
        contact.effective_mass_kg =
            met->isRigid && met->described.mass_kg > 0.0 ? met->described.mass_kg : each.described.mass_kg;
        checkWorld(physvib_world_touch(world, &contact));
        for (std::size_t k = 0; k < 3; ++k) // it slides on
            each.before[k] -= std::max(0.0, approach) * normal[k];
    }
    each.at = now, each.step = step;
}

} // namespace physvib::godot
