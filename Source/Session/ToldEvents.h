// SPDX-License-Identifier: MIT
// What a session tells a second output of what it makes, in parallel to its own renderer's queues.
#pragma once
#include "Core/EventQueue.h"
#include "Core/RenderControl.h"

namespace physvib {

/// In session time, as the renderer gets it. One reader for both.
struct ToldEvents {
    EventQueue<CollisionEvent, 1024> events;  ///< of the world; in time order. Its producer: who holds the world
    EventQueue<RenderControl, 256> controls;  ///< its producer: who posts (the input mutex)
};

} // namespace physvib
