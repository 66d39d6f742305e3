// SPDX-License-Identifier: MIT
// Simulation, which steps a scene's world and delivers its collisions as events in time order; and functions
// that simulate a scene or a session's scene runs offline, for their events or poses; these are for the
// message thread.
#pragma once
#include "Contacts/ImpactSettings.h"
#include "Core/CollisionEvent.h"
#include "Physics/Attachment.h"
#include "Scene/Scene.h"
#include "Scene/SceneEdits.h"
#include "Scene/World/SceneWorld.h"
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace physvib {

/// One world, stepped by its owner. Time is a step count: the same scene, seed and step rate give the same
/// events. One thread at a time. Once Box2D's pools and the lists of contacts are large enough for the
/// simultaneous contacts, step() allocates only to let `finished` grow.
class Simulation {
public:
    static constexpr int minStepsPerSecond = 10;     // at lower rates bodies pass through each other
    static constexpr int maxStepsPerSecond = 10'000; // 0.1 ms, finer than touch can resolve

    /// Seed 0 starts bodies exactly as described; others change the start a little (see jitteredStart).
    /// Throws std::invalid_argument if the scene is invalid (with the text of validate()) or the rate out of
    /// range.
    Simulation(const Scene& scene, std::uint32_t seed, int stepsPerSecond,
               ImpactTiming timing = ImpactTiming::onset, ImpactLocation location = ImpactLocation::contact);
    ~Simulation() { attachment_.detach(); } // detaches before the world is destroyed
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Adds a valid input (see InputCheck). It acts in the first step that begins at or after `timeSeconds`
    /// of world time; in the next step if that is past; and not before inputs that were added earlier.
    void addInput(double timeSeconds, Action action);

    /// Changes the script's pace (see SceneWorld); not recorded in scene().
    void addPace(const ScriptPace& pace) { world_.addPace(pace); }

    /// The scene with all inputs so far: a simulation of it, with the same seed and rate, repeats everything.
    const Scene& scene() const noexcept { return world_.scene(); }

    /// Removes executed inputs from scene(), for endless simulations whose inputs are logged elsewhere.
    void dropExecutedInputs() { world_.dropExecutedInputs(); }

    /// Advances the world by one step and appends the events that are now final.
    void step(std::vector<CollisionEvent>& finished);

    /// World time at the end of the last step.
    std::int64_t timeNs() const noexcept { return clock_.timeNs(stepsDone_); }

    /// All events before this time have been delivered: one step behind timeNs(), because a contact may be
    /// reported one step late.
    std::int64_t settledNs() const noexcept { return clock_.timeNs(stepsDone_ > 0 ? stepsDone_ - 1 : 0); }

    /// Pose of body `index` (< bodyCount()) of allBodies(), at timeNs(). Live inputs add bodies.
    BodyPose pose(std::size_t index) const noexcept { return world_.pose(index); }
    std::vector<JointPose> jointPoses() const { return world_.jointPoses(); }
    std::size_t bodyCount() const noexcept { return world_.bodyCount(); }
    /// Calls `use` with number and pose of every body in Box2D's world, in the order of their numbers.
    template <class Use>
    void forEachBody(Use use) const {
        world_.forEachBody(use);
    }
    /// Number of bodies in Box2D's world, without removed live bodies.
    std::size_t bodiesInBox2d() const noexcept { return world_.bodiesInBox2d(); }

    /// Collisions lost so far because of limits per step or of simultaneous contacts.
    std::uint64_t drops() const noexcept { return attachment_.drops() + world_.refusedContacts(); }

    /// Counts of all contacts so far; see explain().
    ContactCounts counts() const noexcept { return attachment_.counts(); }

    /// The constants of Eq. 5.4 in the last step.
    const ImpactModel& impactModel() const noexcept { return attachment_.impactModel(); }

private:
    void updateFixtures(); // passes new fixtures, sounds, textures and source flags on

    StepClock clock_;
    std::int64_t stepsDone_ = 0;
    SceneWorld world_;
    Attachment attachment_;
};

/// The parameters that determine a scene's events, besides the scene itself.
struct RunSettings {
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    ImpactTiming timing = ImpactTiming::onset;
    ImpactLocation location = ImpactLocation::contact;
};

/// Collisions in time order, and the number of those lost because too many began in one step.
struct SceneEvents {
    std::vector<CollisionEvent> events;
    std::uint64_t drops = 0;
    ContactCounts counts{}; ///< sums over all scene runs
};

/// Called with the session time before the first step of a scene run and after each step; false stops.
using StepWatch = std::function<bool(std::int64_t timeNs)>;

/// The collisions of a scene from its start to `endNs`. Throws like Simulation.
SceneEvents simulateScene(const Scene& scene, const RunSettings& settings, std::int64_t endNs,
                          const StepWatch& keepGoing = {});

/// Recomputes the events of a session, in session time: each scene run to its end, the last one to `endNs`.
/// Seeds are those of the scene runs, not that of `settings`. Throws like Simulation.
SceneEvents simulateRuns(std::span<const SceneRun> runs, const RunSettings& settings, std::int64_t endNs,
                         const StepWatch& keepGoing = {});

/// Poses at the end of the last step up to `timeNs`. Simulates from the start.
WorldPoses posesAt(const Scene& scene, const RunSettings& settings, std::int64_t timeNs);

/// Called with a session time, the scene of its run with all inputs, and the poses at the end of the last
/// step up to that time; false stops.
using RunPoseWatch = std::function<bool(std::int64_t timeNs, const Scene& scene, const WorldPoses& poses)>;

/// Simulates a session, with its pauses and slow motion, and calls `watch` at fromNs, fromNs + everyNs...
/// before `endNs`. `settings`, thread and exceptions as for simulateRuns().
void followRuns(std::span<const SceneRun> runs, const RunSettings& settings, std::int64_t fromNs,
                std::int64_t everyNs, std::int64_t endNs, const RunPoseWatch& watch);

/// Called with a time and the poses at the end of the last step up to that time; false stops.
using PoseWatch = std::function<bool(std::int64_t timeNs, const WorldPoses& poses)>;

/// Simulates a scene from its start, and calls `watch` at 0, everyNs, 2 everyNs... before `endNs`. Throws
/// like Simulation.
void followPoses(const Scene& scene, const RunSettings& settings, std::int64_t everyNs, std::int64_t endNs,
                 const PoseWatch& watch);

} // namespace physvib
