// SPDX-License-Identifier: MIT
// Converts a message to the events that it plays.
#pragma once
#include "Core/EventShaping.h"
#include "Live/Messages/ClipSource.h"
#include "Live/Messages/MessageValues.h"
#include "Scene/Scene.h"
#include <vector>

namespace physvib {

/// Tactile Brush (Israr and Poupyrev 2011): delay between stroke onsets, as a share of the stroke plus a
/// constant in s.
constexpr double strokeOnsetShare = 0.32, strokeOnsetSeconds = 0.0473;

/// Onset delay at which strokes of `strokeSeconds` are felt as one motion. Any thread.
constexpr double strokeOnsetsSeconds(double strokeSeconds) noexcept {
    return strokeOnsetShare * strokeSeconds + strokeOnsetSeconds;
}

/// Length of each of `strokes` (2 or more) so that all together take `seconds`; 0 or less: there is not
/// enough time. Any thread.
constexpr double strokeSeconds(int strokes, double seconds) noexcept {
    return (seconds - strokeOnsetSeconds * (strokes - 1)) / (strokeOnsetShare * (strokes - 1) + 1.0);
}

/// Events of a `clip`: one per channel, from time 0 on, at its place, without the frequency under which the
/// session keeps it. `panner` supplies the actuators' places. Throws MessageError. Any thread but the render
/// thread (R).
std::vector<CollisionEvent> clipStrikes(const MessageValues& values, const LoadedClip& clip,
                                        const PhantomPanner& panner);

} // namespace physvib
