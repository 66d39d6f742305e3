// SPDX-License-Identifier: MIT
// What is done to a session from outside: by a mouse, a line, a message, a program or a beat.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/RenderControl.h"
#include "Live/Documents/Mix.h"
#include "Live/Session/ContactSounds.h"
#include "Scene/Scene.h"
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace physvib {

/// Events apart from the world (a test pulse, a material to be heard), at their own times after the input's;
/// the caller's until it is taken.
struct Strikes {
    std::span<const CollisionEvent> events;
    bool canBeStopped = false; ///< each waits in the session until its time, up to which a Stop can take it
                               ///< back
};

/// What sounds fades out, and what waits for then or later is forgotten.
struct Stop {};

/// Events play these instead of modes; none: modes. Recordings that sound fade out.
struct PlayedRecordings {
    std::vector<ContactRecording> recordings;
};

/// Gains of the strips that have a lane, by themselves or by their group, follow the time of the scene from
/// now on, as faders that are moved: they act at its steps, and are logged. A gain that is told otherwise
/// holds until the scene goes on.
struct Lanes {
    std::shared_ptr<const Mix> mix; ///< null: none do
};

/// One input of any kind.
struct Input {
    static constexpr std::int64_t now = std::numeric_limits<std::int64_t>::min();

    /// An Action acts in the world; a RenderControl changes how later events are rendered.
    std::variant<Action, RenderControl, PlayedRecordings, Strikes, Stop, Lanes> what;
    /// The session time at which it acts; of Strikes and a Stop, what is over by then is late. The others act
    /// now.
    std::int64_t timeNs = now;
};

} // namespace physvib
