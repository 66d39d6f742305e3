// SPDX-License-Identifier: MIT
// Where Box2D's contact points are on the surfaces that touch, and how fast they move along them.
#pragma once
#include "Contacts/LastingContacts.h"
#include <box2d/box2d.h>
#include <cstdint>

namespace physvib {

/// In PostSolve: tells the points of a contact of two slots, but for those in `blows` (a bit each), whose
/// push is a blow. M only.
void tellLasting(const b2Contact& contact, const b2WorldManifold& world, const b2ContactImpulse& impulse,
                 unsigned blows, std::int32_t a, std::int32_t b, LastingContacts& lasting);

} // namespace physvib
