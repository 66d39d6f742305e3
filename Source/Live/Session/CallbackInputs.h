// SPDX-License-Identifier: MIT
// Inputs that arrive in the render call itself (MIDI, automation), on their way to the renderer and the
// world.
#pragma once
#include "Core/ControlQueue.h"
#include "Live/Session/SessionWorld.h"
#include "Live/Session/Timeline.h"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

// Interface of a source of samples, such as incoming audio, that a session mixes with the rendered events.

/// Mixed before the actuators' own stages: level, equaliser, delay and limiter act on all samples alike.
class AddedSamples {
public:
    /// The renderer's frames from `frame` on (session time in frames), at most limits::tileFrames. One
    /// pointer per channel of the session; null: silence. Valid until the next call. R, wait-free.
    virtual const float* const* at(std::int64_t frame, int frames) noexcept = 0;

protected:
    ~AddedSamples() = default;
};

/// Part of a session.
class CallbackInputs {
public:
    /// `frame`: frames into the block that is rendered next. The event is felt at an exact frame: the
    /// output latency later, or the renderer's latency later if the session is direct. False, and counted,
    /// if the queue is full. Render thread (R), wait-free.
    bool strike(CollisionEvent event, int frame) noexcept { return strike(event, frame, 0); }
    /// `afterNs` after that frame, which may be past
    bool strike(CollisionEvent event, int frame, std::int64_t afterNs) noexcept;
    /// its panner is copied; at most 16 of them wait
    bool control(RenderControl control, int frame) noexcept;
    bool perform(RenderInput input, int frame) noexcept; ///< acts in the world's next step, if there is one

    /// Acts at once, without the output latency: sounding modes fade, and earlier events are no longer
    /// played. R, wait-free.
    bool silence(int frame) noexcept;

    /// Mixes in these samples from now on; they must outlive the session. M, not while rendering.
    void add(AddedSamples& samples) noexcept { added_ = &samples; }

private:
    friend class Session;
    friend class WorldRunner;

    /// Both outlive it; of `setup` it uses the shaping of events and the groups of actions.
    CallbackInputs(const Timeline& time, const SessionSetup& setup)
        : time_{time}
        , hasWorld_{setup.hasWorld}
        , shaping_{setup.shaping}
        , groups_{setup.groups} {}

    /// Discards everything queued and spawned. M, not while rendering, with the world mutex held.
    void forget() noexcept;

    /// The next item for the renderer; false: none. R, wait-free.
    bool popStrike(CollisionEvent& strike) noexcept { return strikes_.pop(strike); }
    bool popControl(RenderControl& control) noexcept { return controls_.pop(control); }

    /// Passes R's actions to the world. On the thread that holds the world mutex.
    void handTo(SessionWorld& world);

    /// Items that did not fit the queues. Any thread, wait-free.
    std::uint64_t refused() const noexcept {
        return strikes_.overflows() + controls_.overflows() + inputs_.overflows();
    }

    void addBody(SessionWorld& world, std::int64_t timeNs, SpawnAction action);

    const Timeline& time_;
    const bool hasWorld_;
    const EventShaping shaping_;
    const std::vector<std::vector<Action>>& groups_;
    EventQueue<CollisionEvent, 1024> strikes_; // written and read by R: a dense chord in 8192 frames
    ControlQueue<128, 16> controls_;           // senders limit their rate
    EventQueue<RenderInput, 1024> inputs_;     // from R to the thread that steps the world
    AddedSamples* added_ = nullptr;
    std::uint64_t spawns_ = 0;          // this and the next are guarded by the world mutex
    std::array<std::string, 64> names_; // of the newest bodies that R spawned; no scene needs more at once
};

} // namespace physvib
