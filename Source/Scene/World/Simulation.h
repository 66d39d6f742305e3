// SPDX-License-Identifier: MIT
// Simulation of a scene: steps its world, and delivers its collisions as time-sorted events; of a scene, or a
// session's scene runs, offline from the start to a given time.
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

/// One world, stepped by its owner. Time is a step count; same scene, seed and step rate give the same
/// events. One thread at a time (M unless a driver owns it). Once Box2D's pools and the lists of contacts
/// have grown to what collides at once, step() allocates only where `finished` must grow.
class Simulation {
public:
    static constexpr int minStepsPerSecond = 10;     // at lower rates bodies pass through each other
    static constexpr int maxStepsPerSecond = 10'000; // finer than any tactile onset

    /// Seed 0 starts exactly as described; any other seed moves the start a little (see jitteredStart).
    /// Throws std::invalid_argument, with validate()'s sentence, if the scene or the step rate is out of
    /// range.
    Simulation(const Scene& scene, std::uint32_t seed, int stepsPerSecond,
               ImpactTiming timing = ImpactTiming::onset, ImpactLocation location = ImpactLocation::contact);
    ~Simulation() { attachment_.detach(); } // detaches before the world is destroyed
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Adds an input that is valid (see InputCheck): it acts in the first step that begins at or after
    /// `timeSeconds`, or in the next one if that is past, or when those added before it have acted.
    void addInput(double timeSeconds, Action action);

    /// Changes the script's pace (see SceneWorld); not recorded in scene().
    void pace(const ScriptPace& pace) { world_.pace(pace); }

    /// The scene with all inputs so far: a simulation of it, with the same seed and rate, repeats everything.
    const Scene& scene() const noexcept { return world_.scene(); }

    /// Removes executed inputs from scene(), for endless simulations whose inputs are logged elsewhere.
    void forgetDone() { world_.forgetDone(); }

    /// Advances the world by one step and appends the events that are now final.
    void step(std::vector<CollisionEvent>& finished);

    /// World time after the steps done.
    std::int64_t timeNs() const noexcept { return clock_.timeNs(stepsDone_); }

    /// All events before this time have been delivered: one step behind timeNs(), because a contact may be
    /// reported one step late.
    std::int64_t settledNs() const noexcept { return clock_.timeNs(stepsDone_ > 0 ? stepsDone_ - 1 : 0); }

    /// Pose of body `index` (< bodyCount()) of sceneCast(), at timeNs(). Live inputs add bodies.
    BodyPose pose(std::size_t index) const noexcept { return world_.pose(index); }
    std::vector<JointPose> jointPoses() const { return world_.jointPoses(); }
    std::size_t bodyCount() const noexcept { return world_.bodyCount(); }
    template <class Use>
    void forAllBodies(Use use) const {
        world_.forAllBodies(use);
    } ///< see SceneWorld
    /// Bodies in Box2D's world; removed live bodies are gone.
    std::size_t bodiesInBox2d() const noexcept { return world_.bodiesInBox2d(); }

    /// Collisions lost so far because of limits per step or of simultaneous contacts.
    std::uint64_t drops() const noexcept { return attachment_.drops() + world_.contactsRefused(); }

    /// Counts of all contacts so far; see explain().
    ContactCounts counts() const noexcept { return attachment_.counts(); }

    /// The constants of Eq. 5.4 in the last step.
    const ImpactModel& impactModel() const noexcept { return attachment_.impactModel(); }

private:
    void takeFixtures(); // updates their sounds and source flags

    StepClock clock_;
    std::int64_t stepsDone_ = 0;
    SceneWorld world_;
    Attachment attachment_;
};

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

/// The collisions of a scene from its start. M only. Throws what Simulation throws.
SceneEvents runScene(const Scene& scene, const RunSettings& run, std::int64_t endNs,
                     const StepWatch& keepGoing = {});

/// Recomputes a session's events in session time: each scene run to its end, the last one up to `endNs`.
/// `run` gives the step rate; seeds are the scene runs' own. M only. Throws what Simulation throws.
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
