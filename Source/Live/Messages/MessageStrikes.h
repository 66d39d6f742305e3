// SPDX-License-Identifier: MIT
// From a message to what is struck.
#pragma once
#include "Core/EventShaping.h"
#include "Live/Messages/ClipSource.h"
#include "Live/Messages/MessageValues.h"
#include "Scene/Scene.h"
#include <vector>

namespace physvib {

/// Tactile Brush (Israr and Poupyrev 2011): the onset of the next stroke is so much later, by a share of the
/// stroke and in s.
constexpr double strokeOnsetShare = 0.32, strokeOnsetSeconds = 0.0473;

/// Strokes of so many seconds feel like one motion if they begin this long after each other. Any thread.
constexpr double strokeOnsetsSeconds(double strokeSeconds) noexcept {
    return strokeOnsetShare * strokeSeconds + strokeOnsetSeconds;
}

/// How long each of `strokes` (2 or more) is, so that all take `seconds`; 0 or less: there is no time for so
/// many. Any thread.
constexpr double strokeSeconds(int strokes, double seconds) noexcept {
    return (seconds - strokeOnsetSeconds * (strokes - 1)) / (strokeOnsetShare * (strokes - 1) + 1.0);
}

/// Of a `clip`: each channel from time 0 on, where it belongs, without the frequency under which the session
/// keeps it. `panner` says where the enchanters are. Throws MessageError. Any thread but R.
std::vector<CollisionEvent> clipStrikes(const MessageValues& values, const LoadedClip& clip,
                                        const PhantomPanner& panner);

} // namespace physvib
