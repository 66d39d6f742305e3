// SPDX-License-Identifier: MIT
// A scene's world in motion: steps it, and hands out its collisions as a time-sorted stream of events.
#pragma once
#include "Core/CollisionEvent.h"
#include "Physics/CollisionCatcher.h"
#include "Physics/EventSorter.h"
#include "Physics/GravityScript.h"
#include "Physics/ImpactModel.h"
#include "Physics/Scene.h"
#include "Physics/StepClock.h"
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Where a body is, in metres of the field.
struct BodyPose {
    double xMetres = 0.0;
    double yMetres = 0.0;
    double angleRadians = 0.0;
};

/// One world, stepped by its owner. Time is a step count; same scene, seed and step rate give the same
/// events. One thread at a time (M unless a driver owns it). After the first contacts have warmed Box2D's
/// pools up, step() allocates only where `finished` must grow.
class Simulation {
public:
    static constexpr int minStepsPerSecond = 10;     // slower, bodies pass through each other
    static constexpr int maxStepsPerSecond = 10'000; // finer than any tactile onset

    /// Seed 0 starts exactly as described; any other seed moves the start a little (see drawJitter).
    /// Throws std::invalid_argument, with validate()'s sentence, if the scene or the step rate is out of
    /// range.
    Simulation(const Scene& scene, std::uint32_t seed, int stepsPerSecond);
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Advances the world by one step and appends the events that are final now.
    void step(std::vector<CollisionEvent>& finished);

    /// World time after the steps done.
    std::int64_t timeNs() const noexcept { return clock_.timeNs(stepsDone_); }

    /// Every event before this time has been handed out: one step behind timeNs(), since a contact is noticed
    /// up to one step after it was made.
    std::int64_t settledNs() const noexcept { return clock_.timeNs(stepsDone_ > 0 ? stepsDone_ - 1 : 0); }

    /// Pose of body `index` (< bodyCount()) of the scene, at timeNs().
    BodyPose pose(std::size_t index) const noexcept;
    std::size_t bodyCount() const noexcept { return bodies_.size(); }

    /// Collisions lost so far because more began in one step than there is room for.
    std::uint64_t drops() const noexcept { return catcher_.drops() + held_.drops(); }

    /// The constants of Eq. 5.4 in use.
    const ImpactModel& impactModel() const noexcept { return model_; }

private:
    void build(const Scene& scene, std::uint32_t seed);
    void applyGravity();

    StepClock clock_;
    std::int64_t stepsDone_ = 0;
    GravityScript script_;
    ImpactModel model_;
    CollisionCatcher catcher_;
    EventSorter held_;
    b2World world_;
    std::vector<b2Body*> bodies_; // owned by the world
};

} // namespace physvib
