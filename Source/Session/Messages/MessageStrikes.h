// SPDX-License-Identifier: MIT
// From a message to what is struck.
#pragma once
#include "Core/CollisionEvent.h"
#include "Physics/Scenes/Scene.h"
#include "Session/Messages/MessageValues.h"
#include <vector>

namespace physvib {

/// Tactile Brush (Israr and Poupyrev 2011): strokes of d seconds feel like one motion if they begin this long after each other.
constexpr double strokeOnsetsSeconds(double strokeSeconds) noexcept { return 0.32 * strokeSeconds + 0.0473; }

/// How long each of `strokes` (2 or more) is, so that all take `seconds`; 0 or less: there is no time for so many.
constexpr double strokeSeconds(int strokes, double seconds) noexcept { return (seconds - 0.0473 * (strokes - 1)) / (0.32 * (strokes - 1) + 1.0); }

/// The strikes of a message, in time order, from time 0 on; none of a stop or a query. `materials` are the scene's. Throws
/// MessageError. Any thread but R.
std::vector<CollisionEvent> strikesOf(MessageKind kind, const MessageValues& values, const std::vector<Material>& materials);

} // namespace physvib
