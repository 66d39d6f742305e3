// SPDX-License-Identifier: MIT
// Positions and speeds of Box2D's contact points along the touching surfaces, for rolling and sliding.
#pragma once
#include "Contacts/LastingContacts.h"
#include <box2d/box2d.h>
#include <cstdint>

namespace physvib {

/// In PostSolve: reports the points of a contact of two slots to `lasting`, except those in `collisions` (a
/// bit each), which belong to a collision. World thread (M) only.
void tellLasting(const b2Contact& contact, const b2WorldManifold& world, const b2ContactImpulse& impulse,
                 unsigned collisions, std::int32_t a, std::int32_t b, LastingContacts& lasting);

} // namespace physvib
