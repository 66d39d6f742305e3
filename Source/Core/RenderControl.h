// SPDX-License-Identifier: MIT
// Whatever else is audible travels with a time, as strikes do: layout and law, gains, mutes, delays,
// ceilings, recordings, stop.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/PhantomPanner.h"
#include "Core/RecordedContact.h"
#include <cstdint>

namespace physvib {

/// One change of how events are rendered, at a session time.
struct RenderControl {
    /** What is changed. */ enum class Kind : std::uint8_t {
        panner,     ///< later strikes are panned by `panner`; what rings, rings out where it is
        gain,       ///< of `channel`, to `value`
        mute,       ///< of `channel`: value not 0
        stopAll,    ///< whatever rings fades out; later events are played
        delay,      ///< of `channel`: `value` seconds, 0 to limits::maxChannelDelaySeconds
        ceiling,    ///< of `channel`: largest sample while the limiter is on, `value` > 0, in a ramp
        recordings, ///< from now on `recordings` are played instead of modes; recordings that sound fade out
        level,      ///< of all channels, on top of their gains: `value`, 0 or more
        silence     ///< as stopAll, and events before `untilNs` are not played; if `value` is not 0, of those
                ///< apart from a world only what is before `timeNs`. These two are born in the render call:
                ///< no file names them
    };
    std::int64_t timeNs = 0;       ///< from which on
    Kind kind = Kind::stopAll;     ///< which of the values below counts
    int channel = 0;               ///< of gain and mute
    float value = 0.0f;            ///< gain; of mute, not 0: silent; of silence, see there
    PhantomPanner panner;          ///< of panner
    std::int64_t untilNs = 0;      ///< of silence
    RecordedContacts recordings{}; ///< of recordings
};

/// What was really played, and when: the way back from the renderer to log, view and board.
struct PlayedEvent {
    CollisionEvent event;   ///< as it was struck
    std::int64_t frame = 0; ///< the renderer's first frame of it
    bool isLate = false;    ///< after its time, at once
};

} // namespace physvib
