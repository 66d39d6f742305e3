// SPDX-License-Identifier: MIT
// Live sessions as JSON: scenes, seeds, inputs and controls with their times; rendering them again gives what
// was felt.
#pragma once
#include "Core/EventShaping.h"
#include "Core/HapticRenderer.h"
#include "Io/Result.h"
#include "Live/Documents/Mix.h"
#include "Live/Documents/SessionLog.h"
#include "Scene/World/SceneRun.h"
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace physvib {

/// The version of the format that is written, and the newest that is read.
constexpr int sessionFormatVersion = 8; // 2: desk, strikes, slow motion; 3: recordings, gain, perceived
                                        // level; 4: drags by metres of the screen; 5: strikes that move; 6:
                                        // clips; 7: law of grains, scenes of version 2; 8: groups, lanes

/// A session as it was played.
struct SavedSession {
    SceneRun run;         ///< its seed is not used: each take has its own
    PhantomPanner panner; ///< at the start
    int channels = 0;     ///< outputs, at least as many as any layout of the session has enchanters
    bool limiterEnabled = true;
    /// drive ceiling per channel
    std::array<float, limits::maxEnchanters> ceilings = RendererSettings::fullScale();
    std::int64_t lengthNs = 0;
    SessionLog log;                 ///< at least one take
    std::optional<Mix> mix{};       ///< the desk as it was left, if the session was played on one
    EqualisedActuators equalised{}; ///< per channel
    EventShaping shaping{};         ///< of all collisions
};

/// The session that `text` describes; or, of the first thing that is wrong, one line `name:
/// takes[0].scene.bodies[1]...`. Unknown and repeated fields are errors. Any thread.
Result<SavedSession> readSession(std::string_view text, std::string_view name);

/// The same of a file, beside which its recordings are looked for. M only.
Result<SavedSession> loadSession(const std::filesystem::path& path);

/// The desk as the session left it: its own, or one made of its last scene, layout, gains and mutes. Any
/// thread.
Mix mixOf(const SavedSession& session);

/// `session` as JSON; a take of the same scene as the one before does not repeat it. readSession gives all of
/// it back bit for bit, but labels of enchanters. Paths of recordings become relative to `folder`, in which
/// the file is to stand; empty: they stay as they are. Any thread.
std::string sessionJson(const SavedSession& session, const std::filesystem::path& folder = {});

} // namespace physvib
