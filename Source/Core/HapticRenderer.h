// SPDX-License-Identifier: MIT
// The renderer: collision events in, one channel of samples per actuator out (the thesis' vibration manager).
// All samples are made here.
//
// Order of one call: events enter the pending store; events that are due are panned and struck at their exact
// time between two frames; the mode bank is summed; each channel passes its actuator stage; the linked
// limiter and then the output guard follow. Controls (layout, gains, delays, ceilings, stop) wait for their
// frame in the same way. Work is divided at the tiles of the absolute frame grid and at onsets, gate ends and
// controls, never at block borders: output does not depend on block size.
#pragma once
#include "Core/Actuators/ActuatorStage.h"
#include "Core/Actuators/LinkedLimiter.h"
#include "Core/Actuators/OutputGuard.h"
#include "Core/DenormalGuard.h"
#include "Core/EventQueue.h"
#include "Core/FrameClock.h"
#include "Core/Modes/ModeBank.h"
#include "Core/MovingTones.h"
#include "Core/Nonblocking.h"
#include "Core/PartPanners.h"
#include "Core/RenderControl.h"
#include "Core/RendererSettings.h"
#include "Core/SamplePlayer.h"
#include <array>
#include <cstdint>

namespace physvib {

/// Events that wait to be played: up to a time, and of no world, or of any.
struct WaitingEvents {
    std::int64_t untilNs = 0; ///< the latest time that belongs, of the events' clock
    bool withWorlds = false;  ///< also events of a physics world's fixtures
    /// Whether an event that is due at timeNs belongs.
    bool contain(const CollisionEvent& event, std::int64_t timeNs) const noexcept {
        return timeNs <= untilNs && (withWorlds || event.source.fixture < 0);
    }
};

/// Memory depends on channels and modes and is allocated in prepare. The object itself is large: keep it on
/// the heap.
class HapticRenderer {
public:
    /// Queue of events that were played, with their frames.
    using PlayedQueue = EventQueue<PlayedEvent, static_cast<std::size_t>(limits::playedQueueSize), true>;

    /// Silence at frame 0. False if the settings are not what RendererSettings allows, with at most
    /// limits::maxEnchanters outputs, or if memory is lacking. Then, as before the first call, render writes
    /// zeros and accepts no events, and moveTo fails. Message thread (M), not while rendering.
    bool prepare(const RendererSettings& settings) noexcept;

    /// From now on events play these recordings. The caller keeps the list and its samples, at this sample
    /// rate, alive as long as the renderer. prepare and moveTo forget them. M, not while rendering.
    void setContacts(const RecordedContacts& contacts) noexcept;

    /// Continues at another sample rate and frame, e.g. on another device. Modes continue to sound; pending
    /// events and gains stay; moving tones stop and the limiter starts afresh. False, and nothing has
    /// changed, if the rate is outside the limits or the renderer is not prepared. If memory is lacking, also
    /// false, and the renderer is no longer prepared. M, not while rendering.
    bool moveTo(int sampleRateHz, std::int64_t frame) noexcept;

    /// Writes out[channel][0..frames), 1 to limits::maxBlockFrames. `source.pop(CollisionEvent&)` delivers
    /// events until it returns false. Events that the pending store cannot hold stay in the source; they are
    /// in time if the source is in time order. Optional members of the source: `pop(RenderControl&)` delivers
    /// controls the same way, whose panners must stay until `done(const RenderControl&)` is called;
    /// `struck(const CollisionEvent&, std::int64_t frame)` is called for each event that is played, with the
    /// renderer's first frame of it; `added(std::int64_t frame, int frames)` returns samples, one pointer per
    /// channel, that are mixed in (null: none). Render thread (R), wait-free.
    template <class Source>
    void render(Source& source, float* const* out, int frames) noexcept PHYSVIB_NONBLOCKING;

    /// Discards these events, here and in `source`; returns how many they were. R, wait-free.
    template <class Source>
    int discard(Source& source, const WaitingEvents& which) noexcept PHYSVIB_NONBLOCKING;

    /// Events that have been played, for one reader on another thread.
    PlayedQueue& played() noexcept { return playedQueue_; }

    /// Frames by which the output lags behind the event times (the limiter's look-ahead). Any thread after
    /// prepare.
    int latencyFrames() const noexcept { return limiter_.latencyFrames(); }
    /// The same for a sample rate. Any thread.
    static int latencyFramesAt(int sampleRateHz) noexcept {
        return LinkedLimiter::latencyFramesAt(sampleRateHz);
    }

    /// R only.
    RenderStatus status() const noexcept;

private:
    using Channels = std::array<float*, static_cast<std::size_t>(limits::maxEnchanters)>;
    template <class Source>
    void refill(Source& source) noexcept;
    static bool canTake(const RendererSettings& settings) noexcept;
    bool canPlay(const CollisionEvent& event) const noexcept {
        return isPlayable(event) && event.frequencyHz < 0.5 * clock_.sampleRateHz();
    }
    template <class Source>
    int strikeAndReach(Source& source, int most) noexcept;
    bool passModes(const Channels& out, int frames) noexcept;
    void playAll(const Channels& out, int frames, const float* const* added) noexcept;
    void guard(const Channels& out, int frames, bool isSilent) noexcept;
    template <class Source>
    void actOnDue(Source& source) noexcept;
    void apply(const RenderControl& control) noexcept;
    bool prepareLimiter() noexcept;
    bool takeMemory() noexcept;
    bool strike(const CollisionEvent& event, FramePosition onset) noexcept;
    bool isSilenced(const CollisionEvent& event) const noexcept;
    int discardWaiting(const WaitingEvents& which) noexcept;
    bool strikeStill(const CollisionEvent& event, FramePosition onset, std::int64_t closeFrame) noexcept;
    bool strikeCoupled(Strike strike) noexcept;
    MovingTones::Drive driveAt(const CollisionEvent& event) noexcept;
    bool isCoupled() const noexcept {
        return settings_.drives.isOn() &&
               settings_.drives.channels == static_cast<std::size_t>(panners_.whole().channels());
    }
    std::int64_t nextChange(int most) const noexcept;

    FrameClock clock_;
    PartPanners panners_;
    PhantomPanner::Gains gains_{};
    ModeBank bank_;
    SamplePlayer player_;
    MovingTones moving_;
    ActuatorStage actuators_;
    LinkedLimiter limiter_;
    OutputGuard guard_;
    TimeOrdered<CollisionEvent, limits::maxPending, true> pending_;
    TimeOrdered<RenderControl, limits::maxControls, true> controls_;
    PlayedQueue playedQueue_;
    RendererSettings settings_;
    int channels_ = 1;
    bool isPrepared_ = false;
    bool othersAreModes_ = false; // events without a recording play their mode
    // events before this time are not played; the second: of events that no world produced
    std::int64_t position_ = 0, silentUntilNs_ = INT64_MIN, strikesSilentUntilNs_ = INT64_MIN;
    std::uint64_t played_ = 0, late_ = 0, rejected_ = 0, withoutPart_ = 0;
};

} // namespace physvib

#include "Core/RenderLoop.h"
