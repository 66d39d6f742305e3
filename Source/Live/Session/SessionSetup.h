// SPDX-License-Identifier: MIT
// Settings of a session, the part of them that can change while it plays, and its status.
#pragma once
#include "Core/ClockLaw.h"
#include "Core/EventShaping.h"
#include "Core/HapticRenderer.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/OnsetMarks.h"
#include "Scene/LayoutFile.h"
#include "Scene/World/Simulation.h"
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace physvib {

/// An input from the render call to the world: the device's orientation, or a prepared group of actions.
struct RenderInput {
    static constexpr int device = -1, script = -2;
    int group = device; ///< index into SessionSetup::groups
    double scale = 1.0; ///< factor on the group's impulses, and on the velocities of bodies that it spawns
    union {
        HoldAction hold{};    ///< if `group` is device
        double scriptSeconds; ///< if script: its position, which goes on at the rate `scale`; not logged
    };
    std::int64_t timeNs = 0; ///< set by the session
};

/// Low-latency mode for what needs no world: events from outside and controls. The world's own collisions
/// always have the output latency.
enum class Direct {
    no,       ///< the output latency for all
    inputs,   ///< inputs are felt ClockLaw::directFrames() after they arrive
    fromStart ///< in addition, events of the render call are felt the renderer's latency after their frame,
              ///< from the first frame on; only for a session without a log
};

/// How the log of a session is used; it keeps entries until they are read.
enum class LogUse {
    none,     ///< not at all: nothing is kept
    document, ///< by a reader that keeps all of it: inputs are refused when a file of them would be too large
    stream    ///< by a journal that ends when its file is full; the session plays on
};

/// Settings of a session.
struct SessionSetup {
    Scene scene;
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    /// False: nothing can move in the scene, and all events and samples come in the render call. The world is
    /// never stepped, and the output latency is longestGapSeconds and the limiter's.
    bool hasWorld = true;
    ImpactTiming timing = ImpactTiming::onset;
    ImpactLocation location = ImpactLocation::contact;
    int channels = 4;
    int modes = 0;        ///< see RendererSettings
    PhantomPanner panner; ///< at most `channels` actuators
    bool limiterEnabled = true;
    bool normalisesBlocks = false; ///< see RendererSettings
    /// drive ceiling per channel, > 0
    std::array<float, limits::maxActuators> ceilings = RendererSettings::fullScale();
    EqualisedActuators equalised{};
    EventShaping shaping;                     ///< of all collisions, and of events of the render call
    std::vector<ContactRecording> recordings; ///< played instead of modes; empty: modes
    /// Audio of contacts on channels behind the actuators', by these recordings where there is one, else by
    /// modes; nullopt: none.
    std::optional<std::vector<ContactRecording>> contactSound{};
    int contactChannels = 1; ///< of the audio of contacts: 1, or 2 for left and right
    Direct direct = Direct::no;
    std::optional<MarkedOnsets> marks{}; ///< trigger output: pulses at onsets, on the last channel
    double longestGapSeconds = messageTimerGapSeconds;
    std::vector<std::vector<Action>> groups; ///< actions of notes; valid inputs of the scene
    LogUse log = LogUse::document;
    LayoutDescription layout{}; ///< of `panner`, for the log: name, labels, full scales; empty: not known

    /// Whether events that name fixtures come from a world of the caller, as the scene has no bodies.
    bool hasCallerEvents() const noexcept { return scene.bodies.empty(); }
    RunSettings run() const noexcept { return {seed, stepsPerSecond, timing, location}; }
};

/// Size of a session's contents, beside its scene.
struct SessionSize {
    std::size_t bodies = 0;  ///< in Box2D's world
    std::size_t inputs = 0;  ///< pending, or logged and not read
    std::size_t strikes = 0; ///< scheduled, not begun
};

/// The part of the setup that can be exchanged while it plays.
struct SessionState {
    std::shared_ptr<const Scene> scene;
    std::uint32_t seed = 1;
    bool operator==(const SessionState& other) const {
        return seed == other.seed && (scene == other.scene || *scene == *other.scene);
    }
};

/// Whether the host calls render() in real time, or offline as fast as it can.
enum class RenderMode { realtime, offline };

constexpr std::int64_t noMargin = std::numeric_limits<std::int64_t>::max();

/// Status of a session, for display.
struct SessionStatus {
    RenderStatus render;
    std::int64_t sessionNs = 0;
    std::int64_t minMarginFrames = noMargin; ///< smallest margin of an event in realtime blocks; < 0: late
    std::uint64_t refused = 0; ///< events, controls and inputs of the render call, and contact sounds, that
                               ///< did not fit their queues
};

} // namespace physvib
