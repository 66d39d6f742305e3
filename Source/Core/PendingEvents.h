// SPDX-License-Identifier: MIT
// The renderer's store of events whose time has not come yet.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/TimeOrdered.h"

namespace physvib {

/// Collision events by onset time in nanoseconds.
template <int Capacity>
using PendingEvents = TimeOrdered<CollisionEvent, Capacity>;

} // namespace physvib
