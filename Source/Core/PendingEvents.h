// SPDX-License-Identifier: MIT
// The renderer's store of events whose time has not come yet.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/TimeOrdered.h"

namespace physvib {

/// Collision events by onset time in nanoseconds.
template <class Profile>
using PendingEvents = TimeOrdered<CollisionEvent, Profile::maxPending, Profile::isOnHeap>;

} // namespace physvib
