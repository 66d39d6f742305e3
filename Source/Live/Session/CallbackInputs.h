// SPDX-License-Identifier: MIT
// What comes in the render call itself (MIDI, automation), on its way to the renderer and to the world.
#pragma once
#include "Core/EventQueue.h"
#include "Core/RenderControl.h"
#include "Live/Session/AddedSamples.h"
#include "Live/Session/SessionWorld.h"
#include "Live/Session/Timeline.h"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// Part of a session.
class CallbackInputs {
public:
    /// Each `frame` frames into the block that is rendered next: it is felt L later like everything else, or
    /// the renderer's latency later where the session is direct, at an exact frame. False, and counted, if it
    /// found no room. R, wait-free.
    bool strike(CollisionEvent event, int frame) noexcept { return strike(event, frame, 0); }
    /// so long after that frame, which may be past
    bool strike(CollisionEvent event, int frame, std::int64_t afterNs) noexcept;
    bool control(RenderControl control, int frame) noexcept;
    bool perform(RenderInput input, int frame) noexcept; ///< acts in the world's next step

    /// Not L later but as soon as it can be: what rings fades, and what happened before is not felt any more.
    /// As the others. R, wait-free.
    bool silence(int frame) noexcept;

    /// These samples are played as well, from now on; they outlive the session. M, while nobody renders.
    void add(AddedSamples& samples) noexcept { added_ = &samples; }

private:
    friend class Session;
    friend class WorldRunner;

    /// `time` outlives it; of `setup`, what strikes are shaped by and the groups of inputs.
    CallbackInputs(const Timeline& time, const SessionSetup& setup)
        : time_{time}
        , shaping_{setup.shaping}
        , groups_{setup.groups} {}

    /// Nothing was born, nothing spawned. M, while nobody renders, under the world mutex.
    void forget() noexcept;

    /// The next for the renderer; false: none. R, wait-free.
    bool popStrike(CollisionEvent& strike) noexcept { return strikes_.pop(strike); }
    bool popControl(RenderControl& control) noexcept { return controls_.pop(control); }

    /// What R asks of the world, which is told to it. Whoever holds the world.
    void handTo(SessionWorld& world);

    /// All that found no room. Any thread, wait-free.
    std::uint64_t refused() const noexcept {
        return strikes_.overflows() + controls_.overflows() + inputs_.overflows();
    }

    void addBody(SessionWorld& world, std::int64_t timeNs, SpawnAction action);

    const Timeline& time_;
    const EventShaping shaping_;
    const std::vector<std::vector<Action>> groups_;
    EventQueue<CollisionEvent, 1024> strikes_; // both ends are R: a dense chord in a block of 8192 frames
    EventQueue<RenderControl, 128> controls_;  // whoever sends them keeps to a pace
    EventQueue<RenderInput, 1024> inputs_;     // from R to whoever steps the world
    AddedSamples* added_ = nullptr;
    std::uint64_t spawns_ = 0;          // the world's, as what follows
    std::array<std::string, 64> names_; // of bodies that R spawned, the newest; no world here needs more at
                                        // once
};

} // namespace physvib
