// SPDX-License-Identifier: MIT
// The only way to samples: collision events in, one channel per enchanter out (the thesis' vibration
// manager).
//
// Order of one call: events enter the pending store; those that are due are panned and struck on their exact
// place between two frames; the mode bank is summed; each channel goes through its actuator stage; the linked
// limiter follows, and the guard has the last word. Controls (layout, gains, delays, ceilings, stop) wait for
// their frame in the same way. Work is cut at the tiles of the
// absolute frame grid and at onsets, gate ends and controls, never at block borders: output does not depend
// on block size.
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
#include "Core/PhantomPanner.h"
#include "Core/RenderControl.h"
#include "Core/RendererSettings.h"
#include "Core/SamplePlayer.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// Its memory follows channels and modes and is taken in prepare; the object itself is large: keep it on the
/// heap.
class HapticRenderer {
public:
    /// What was played, and when.
    using PlayedQueue = EventQueue<PlayedEvent, static_cast<std::size_t>(limits::playedQueueSize)>;

    /// Silence at frame 0. False if the settings are not what RendererSettings allows, with at most
    /// limits::maxEnchanters outputs, or if there is no memory: then render writes zeros, takes no events and
    /// moves nowhere, as before the first call. M, not while rendering.
    bool prepare(const RendererSettings& settings) noexcept;

    /// From now on events play these recordings. Both the list and its samples, at this rate, outlive the
    /// renderer. prepare and moveTo forget them. M, not while rendering.
    void setContacts(const RecordedContacts& contacts) noexcept;

    /// Goes on at another rate and frame, e.g. on another device: modes ring on, pending events and gains
    /// stay; what moves stops, the limiter starts afresh. False, and nothing has changed, at a rate outside
    /// the limits, or if it is not prepared; without memory it is not prepared any more. M, not while
    /// rendering.
    bool moveTo(int sampleRateHz, std::int64_t frame) noexcept;

    /// Writes out[channel][0..frames), 1 to limits::maxBlockFrames. `source.pop(CollisionEvent&)` gives
    /// events until it says false; more than the pending store holds stay there, which is right if they come
    /// in time order. If it also has `pop(RenderControl&)`, controls come the same way; if it has
    /// `struck(const CollisionEvent&, std::int64_t frame)`, it is told of what is played, and of which frame
    /// of the renderer's on; if it has `added(std::int64_t frame, int frames)`, the samples that it points
    /// to, a channel each, are played as well (null: none). R, wait-free.
    template <class Source>
    void render(Source& source, float* const* out, int frames) noexcept PHYSVIB_NONBLOCKING;

    /// What has been played, for one reader on another thread.
    PlayedQueue& played() noexcept { return playedQueue_; }

    /// Frames by which the output lags the event times (the limiter's look-ahead). Any thread after prepare.
    int latencyFrames() const noexcept { return limiter_.latencyFrames(); }
    /// Any thread.
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
    void actOnDue() noexcept;
    void apply(const RenderControl& control) noexcept;
    bool prepareLimiter() noexcept;
    bool takeMemory() noexcept;
    bool strike(const CollisionEvent& event, FramePosition onset) noexcept;
    bool isSilenced(const CollisionEvent& event) const noexcept;
    bool strikeStill(const CollisionEvent& event, FramePosition onset, std::int64_t closeFrame) noexcept;
    bool strikeCoupled(Strike strike) noexcept;
    MovingTones::Drive driveAt(const CollisionEvent& event, double x, double y) noexcept;
    bool isCoupled() const noexcept {
        return settings_.drives.isOn() &&
               settings_.drives.channels == static_cast<std::size_t>(panner_.channels());
    }
    std::int64_t nextChange(int most) const noexcept;

    FrameClock clock_;
    PhantomPanner panner_;
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
    bool othersAreModes_ = false; // events without a recording
    // no event before it is played; none that is apart from a world
    std::int64_t position_ = 0, silentUntilNs_ = INT64_MIN, strikesSilentUntilNs_ = INT64_MIN;
    std::uint64_t played_ = 0, late_ = 0, rejected_ = 0;
};

} // namespace physvib

#include "Core/RenderLoop.h"
