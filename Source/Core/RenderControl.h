// SPDX-License-Identifier: MIT
// Timed control changes of the renderer (layout and panning law, gains, mutes, delays, ceilings, recordings,
// stop), and the record of a played event. A control fits a cache line, since it is copied from queue to
// queue; what is larger it names.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/PhantomPanner.h"
#include "Core/RecordedContact.h"
#include <cstdint>
#include <type_traits>

namespace physvib {

/// One change of how events are rendered, at a session time.
struct RenderControl {
    /** What changes. */ enum class Kind : std::uint8_t {
        panner,     ///< later events are panned by `panner`; sounding modes keep their gains
        gain,       ///< of `channel`, to `value`
        mute,       ///< of `channel`: muted if value is not 0
        stopAll,    ///< all sounding modes and recordings fade out; later events are played
        delay,      ///< of `channel`: `value` seconds, 0 to limits::maxChannelDelaySeconds
        ceiling,    ///< of `channel`: largest sample while the limiter is on, `value` > 0, reached in a ramp
        recordings, ///< from now on `recordings` are played instead of modes; sounding recordings fade out
        level,      ///< of all channels, multiplied with their gains: `value`, 0 or more
        silence ///< as stopAll, and events before `untilNs` are not played. If `value` is not 0, events that
                ///< no world produced are blocked only before `timeNs`. level and silence are created by the
                ///< render call; files do not name them
    };
    std::int64_t timeNs = 0;   ///< session time at which it takes effect
    Kind kind = Kind::stopAll; ///< selects which of the values below counts
    int channel = 0;           ///< for gain, mute, delay and ceiling
    float value = 0.0f;        ///< see Kind
    /// for panner: not null. Its sender keeps it until the reader is done with it; see ControlQueue
    const PhantomPanner* panner = nullptr;
    std::int64_t untilNs = 0;      ///< for silence
    RecordedContacts recordings{}; ///< for recordings
};
static_assert(sizeof(RenderControl) <= 64 && std::is_trivially_copyable_v<RenderControl>);

/// An event that was played, and when: sent from the renderer to log, view and board.
struct PlayedEvent {
    CollisionEvent event;   ///< as it was played
    std::int64_t frame = 0; ///< the renderer's first frame of it
    bool isLate = false;    ///< played after its time, at once
};

} // namespace physvib
