// SPDX-License-Identifier: MIT
// The inputs to a session from outside: by mouse, text line, message, program or sequencer.
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

/// Events that no world produced (a test pulse, a material preview), at their own times after the input's.
/// The caller keeps them alive during the call.
struct Strikes {
    std::span<const CollisionEvent> events;
    bool canBeStopped = false; ///< events stay in the session until their time, and a Stop can discard them
                               ///< until then
};

/// Fades out what sounds, and discards pending events from its time on.
struct Stop {};

/// Recordings that events play instead of modes; empty: modes. Sounding recordings fade out.
struct PlayedRecordings {
    std::vector<ContactRecording> recordings;
};

/// From now on automated gains (lanes) follow the scene's time, of each strip that has a lane itself or by
/// its group. They act at the world's steps like moved faders, and are logged. A gain that is set otherwise
/// holds until the scene time advances.
struct Lanes {
    std::shared_ptr<const Mix> mix; ///< null: no lanes
};

/// One input of any kind.
struct Input {
    static constexpr std::int64_t now = std::numeric_limits<std::int64_t>::min();

    /// An Action acts in the world; a RenderControl changes how later events are rendered.
    std::variant<Action, RenderControl, PlayedRecordings, Strikes, Stop, Lanes> what;
    /// Session time at which it acts. Strikes and Stop may be in the future; if that time is past they are
    /// late. All other inputs act now.
    std::int64_t timeNs = now;
};

} // namespace physvib
