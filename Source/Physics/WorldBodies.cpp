// SPDX-License-Identifier: MIT
// Looks up bodies in the world's list, if some may have been destroyed without a callback.
#include "Physics/WorldBodies.h"

namespace physvib {

bool WorldBodies::has(std::uint64_t body) const {
    if (!isCertain_) {
        for (const b2Body* const present : present_)
            if (present != nullptr && nameOf(*present) == body) return true;
        look();
    }
    return bodies_.find(body) != IntegerMap::none;
}

// If the list has the same addresses in the same order, the index is still valid, even if a body was replaced
// by another at its address.
void WorldBodies::look() const {
    isCertain_ = true;
    const std::uint64_t census = BodySweeps::censusOf(world_);
    if (census == census_) return;
    census_ = census;
    bodies_.clear();
    for (const b2Body* body = world_.GetBodyList(); body != nullptr; body = body->GetNext())
        bodies_.set(nameOf(*body), 0);
}

double WorldBodies::inertia(std::uint64_t body) const {
    if (!has(body)) return 0.0;
    const b2Body& of = bodyOf(body);
    return of.GetInertia() - of.GetMass() * of.GetLocalCenter().LengthSquared();
}

} // namespace physvib
