// SPDX-License-Identifier: MIT
// What a session is made of, what can be exchanged while it plays, and what it tells of itself.
#pragma once
#include "Core/ClockLaw.h"
#include "Core/EventShaping.h"
#include "Core/HapticRenderer.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/OnsetMarks.h"
#include "Scene/World/SceneRun.h"
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace physvib {

/// What the render call may do to the world: hold the device another way, or perform a group of actions that
/// was prepared.
struct RenderInput {
    static constexpr int device = -1;
    int group = device;      ///< index into SessionSetup::groups
    double scale = 1.0;      ///< of the group's impulses, and of the velocities of what it spawns
    HoldAction hold;         ///< if `group` is device
    std::int64_t timeNs = 0; ///< given by the session
};

/// How soon that is felt which needs no world: strikes apart from it, and controls. Its own collisions are
/// felt L later in any case.
enum class Direct {
    no,   ///< L later as well
    told, ///< ClockLaw::directFrames() after it was told
    born  ///< so is what is told, and what is born in the render call the renderer's latency after its frame,
          ///< from the first one on; of a session without a log
};

/// Who reads the log of a session; it keeps what has not been read.
enum class LogUse {
    none,     ///< nobody: nothing is kept, however long it plays
    document, ///< somebody who keeps all of it: inputs are refused when a file of them would be
    stream    ///< a journal that ends when its file is full; the session plays on
};

/// What a session plays, and on what.
struct SessionSetup {
    Scene scene;
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    ImpactTiming timing = ImpactTiming::onset;
    ImpactLocation location = ImpactLocation::contact;
    int channels = 4;
    int modes = 0;        ///< of RendererSettings
    PhantomPanner panner; ///< at most `channels` enchanters
    bool limiterEnabled = true;
    /// drive ceiling per channel, > 0
    std::array<float, limits::maxEnchanters> ceilings = RendererSettings::fullScale();
    EqualisedActuators equalised{};
    EventShaping shaping;                     ///< of all collisions, and of what is struck in the render call
    std::vector<ContactRecording> recordings; ///< played instead of modes; none: modes
    /// Heard on a channel behind the enchanters' ones: by these recordings where there is one, else by modes;
    /// nullopt: not made.
    std::optional<std::vector<ContactRecording>> contactSound{};
    int ears = 1; ///< of the contact sound: 1, at one place; 2, left and right
    Direct direct = Direct::no;
    std::optional<MarkedOnsets> marks{}; ///< pulses at onsets, on the last channel; nullopt: not made
    double longestGapSeconds = messageTimerGapSeconds;
    std::vector<std::vector<Action>> groups; ///< what notes do; valid inputs of the scene
    LogUse log = LogUse::document;

    SceneRun run() const noexcept { return {seed, stepsPerSecond, timing, location}; }
};

/// What a session holds, beside its scene.
struct SessionSize {
    std::size_t bodies = 0;  ///< in Box2D's world
    std::size_t inputs = 0;  ///< waiting, or of the log and not read
    std::size_t strikes = 0; ///< scheduled, and not begun
};

/// The part of it that can be exchanged while it plays.
struct SessionState {
    std::shared_ptr<const Scene> scene;
    std::uint32_t seed = 1;
    bool operator==(const SessionState& other) const {
        return seed == other.seed && (scene == other.scene || *scene == *other.scene);
    }
};

/// How the host calls render.
enum class RenderMode { realtime, offline };

constexpr std::int64_t noMargin = std::numeric_limits<std::int64_t>::max();

/// A moment of the session, for people.
struct SessionStatus {
    RenderStatus render;
    std::int64_t sessionNs = 0;
    std::int64_t leastMarginFrames = noMargin; ///< by how much the tightest event of realtime blocks came in
                                               ///< time; < 0: late
    std::uint64_t refused = 0; ///< strikes, controls and inputs of the render call, and contact sounds, that
                               ///< found no room
};

} // namespace physvib
