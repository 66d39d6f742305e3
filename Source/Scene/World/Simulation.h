// SPDX-License-Identifier: MIT
// A scene's world in motion: steps it, and hands out its collisions as a time-sorted stream of events.
#pragma once
#include "Contacts/ImpactModel.h"
#include "Core/CollisionEvent.h"
#include "Physics/Attachment.h"
#include "Scene/Scene.h"
#include "Scene/World/SceneWorld.h"
#include "Scene/World/StepClock.h"
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// One world, stepped by its owner. Time is a step count; same scene, seed and step rate give the same
/// events. One thread at a time (M unless a driver owns it). After the first contacts have warmed Box2D's
/// pools up, step() allocates only where `finished` must grow.
class Simulation {
public:
    static constexpr int minStepsPerSecond = 10;     // slower, bodies pass through each other
    static constexpr int maxStepsPerSecond = 10'000; // finer than any tactile onset

    /// Seed 0 starts exactly as described; any other seed moves the start a little (see jitteredStart).
    /// Throws std::invalid_argument, with validate()'s sentence, if the scene or the step rate is out of
    /// range.
    Simulation(const Scene& scene, std::uint32_t seed, int stepsPerSecond,
               ImpactTiming timing = ImpactTiming::onset, ImpactLocation location = ImpactLocation::contact);
    ~Simulation() { attachment_.detach(); } // the world is still there, and leaves with it
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Adds an input that is valid (see InputCheck): it acts in the first step that begins at or after
    /// `timeSeconds`, or in the next one if that is past, or when those added before it have acted.
    void addInput(double timeSeconds, Action action);

    /// The scene with all inputs so far: a simulation of it, with the same seed and rate, does all of it
    /// again.
    const Scene& scene() const noexcept { return world_.scene(); }

    /// Drops from scene() the inputs that have acted, for simulations without end whose inputs are kept
    /// elsewhere.
    void forgetDone() { world_.forgetDone(); }

    /// Advances the world by one step and appends the events that are final now.
    void step(std::vector<CollisionEvent>& finished);

    /// World time after the steps done.
    std::int64_t timeNs() const noexcept { return clock_.timeNs(stepsDone_); }

    /// Every event before this time has been handed out: one step behind timeNs(), since a contact is noticed
    /// up to one step after it was made.
    std::int64_t settledNs() const noexcept { return clock_.timeNs(stepsDone_ > 0 ? stepsDone_ - 1 : 0); }

    /// Pose of body `index` (< bodyCount()) of sceneCast(), at timeNs(). Live inputs make bodies more.
    BodyPose pose(std::size_t index) const noexcept { return world_.pose(index); }
    std::size_t bodyCount() const noexcept { return world_.bodyCount(); }
    template <class Use>
    void forAllBodies(Use use) const {
        world_.forAllBodies(use);
    } ///< see SceneWorld
    /// Those that Box2D knows: what inputs spawn and remove goes.
    std::size_t bodiesInBox2d() const noexcept { return world_.bodiesInBox2d(); }

    /// Collisions lost so far because more began in one step, or lasted at once, than there is room for.
    std::uint64_t drops() const noexcept { return attachment_.drops() + world_.contactsRefused(); }

    /// What became of all contacts so far; see explain().
    ContactCounts counts() const noexcept { return attachment_.counts(); }

    /// The constants of Eq. 5.4 in the last step.
    const ImpactModel& impactModel() const noexcept { return attachment_.impactModel(); }

private:
    void takeFixtures(); // their sounds and cameras as they are now

    StepClock clock_;
    std::int64_t stepsDone_ = 0;
    SceneWorld world_;
    Attachment attachment_;
};

} // namespace physvib
