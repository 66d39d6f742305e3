// SPDX-License-Identifier: MIT
// Timed control changes of the renderer (layout and panning law, gains, mutes, delays, ceilings, recordings,
// stop), and the record of a played event. A control fits a cache line, since it is copied from queue to
// queue; it points to larger data.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/NameNumbers.h"
#include "Core/PhantomPanner.h"
#include <cstdint>
#include <span>
#include <type_traits>

namespace physvib {

/// A recorded contact that is played instead of modes. It is found by the number of its sound or, if it has
/// none, by the frequency of its events. The caller keeps the samples alive as long as the renderer; they are
/// at the renderer's rate.
struct RecordedContact {
    double frequencyHz = 0.0;       ///< of its events, if `sound` is 0
    std::span<const float> samples; ///< for an event of amplitude 1
    SoundNumber sound = 0;          ///< 0: of all events of that frequency whose own sound has no recording
};

/// The recordings of a renderer; without any, all events play modes.
struct RecordedContacts {
    std::span<const RecordedContact> list{}; ///< at the renderer's rate
    bool othersAreModes = false; ///< events without a recording play their mode; if false they are rejected
};

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

/// What all controls sent so far add up to, due or not, to explain silence. One thread at a time.
struct LastChanges {
    PhantomPanner panner;           ///< of later events
    double level = 1.0;             ///< of all channels
    std::int64_t silentUntilNs = 0; ///< no earlier event is played
    std::uint64_t muted = 0;        ///< bit j: channel j
    std::uint64_t zeroGains = 0;    ///< bit j: channel j

    std::uint64_t mutedChannels() const noexcept { return muted | zeroGains; } ///< those that play nothing

    /// Takes over one control; call it in the order in which they are sent.
    void apply(const RenderControl& control) noexcept {
        using Kind = RenderControl::Kind;
        const std::uint64_t bit = std::uint64_t{1} << (static_cast<unsigned>(control.channel) % 64U);
        if (control.kind == Kind::panner && control.panner != nullptr) panner = *control.panner;
        if (control.kind == Kind::level) level = static_cast<double>(control.value);
        if (control.kind == Kind::silence) silentUntilNs = control.untilNs;
        if (control.kind == Kind::mute) muted = control.value != 0.0F ? muted | bit : muted & ~bit;
        if (control.kind == Kind::gain)
            zeroGains = control.value != 0.0F ? zeroGains & ~bit : zeroGains | bit;
    }
};

} // namespace physvib
