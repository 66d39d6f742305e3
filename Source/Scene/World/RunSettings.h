// SPDX-License-Identifier: MIT
// Simulates a scene, or a session's scene runs, offline from the start to a given time.
#pragma once
#include "Core/CollisionEvent.h"
#include "Scene/Scene.h"
#include "Scene/SceneRun.h"
#include "Scene/World/Simulation.h"
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace physvib {

/// Parameters that determine a scene's events, beside the scene.
struct RunSettings {
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    ImpactTiming timing = ImpactTiming::onset;
    ImpactLocation location = ImpactLocation::contact;
};

/// All collisions before `endNs`, in time order, and how many were lost (if thousands begin in one step).
struct SceneEvents {
    std::vector<CollisionEvent> events;
    std::uint64_t drops = 0;
    ContactCounts counts{}; ///< of all scene runs
};

/// Called before the first step of a scene run and after each step, with the session time; false stops.
using StepWatch = std::function<bool(std::int64_t timeNs)>;

/// M only. Throws what Simulation throws.
SceneEvents runScene(const Scene& scene, const RunSettings& run, std::int64_t endNs,
                     const StepWatch& keepGoing = {});

/// Recomputes a session's events in session time: of each scene run to its end, of the last one all before
/// `endNs`. `run` gives the step rate; seeds are the scene runs' own. M only. Throws what Simulation throws.
SceneEvents runTakes(std::span<const SceneRun> takes, const RunSettings& run, std::int64_t endNs,
                     const StepWatch& keepGoing = {});

/// Poses at the last step not after `timeNs`. M only; simulates from the start.
WorldPoses posesAt(const Scene& scene, const RunSettings& run, std::int64_t timeNs);

/// Receives a session time, the scene of its run with all inputs, and the poses at the last step not after
/// it; false stops.
using TakeWatch = std::function<bool(std::int64_t timeNs, const Scene& scene, const WorldPoses& poses)>;

/// Follows a session at fromNs, fromNs + everyNs... before `endNs`, with its pauses and slow motion. `run`,
/// thread and errors as of runTakes.
void followTakes(std::span<const SceneRun> takes, const RunSettings& run, std::int64_t fromNs,
                 std::int64_t everyNs, std::int64_t endNs, const TakeWatch& see);

/// Receives a time and the poses at the last step not after it; false stops.
using PoseWatch = std::function<bool(std::int64_t timeNs, const WorldPoses& poses)>;

/// The same at 0, everyNs, 2 everyNs... before `endNs`, in one go. M only; simulates from the start. Throws
/// what Simulation throws.
void followPoses(const Scene& scene, const RunSettings& run, std::int64_t everyNs, std::int64_t endNs,
                 const PoseWatch& see);

} // namespace physvib
