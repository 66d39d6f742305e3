// SPDX-License-Identifier: MIT
// Builds a scene's world and advances it step by step.
#include "Physics/Simulation.h"
#include "Physics/SceneValidation.h"
#include <stdexcept>
#include <string>

namespace physvib {

namespace {

// Box2D's recommended numbers of iterations.
constexpr int velocityIterations = 8;
constexpr int positionIterations = 3;

// Two cameras per contact, of this step and of the one whose events still wait.
constexpr std::size_t heldEvents = 4 * CollisionCatcher::maxRecords;

StepClock checkedClock(const Scene& scene, int stepsPerSecond) {
    if (const std::string fault = validate(scene); !fault.empty()) throw std::invalid_argument(fault);
    if (stepsPerSecond < Simulation::minStepsPerSecond || stepsPerSecond > Simulation::maxStepsPerSecond)
        throw std::invalid_argument("steps per second: expected " +
                                    std::to_string(Simulation::minStepsPerSecond) + " to " +
                                    std::to_string(Simulation::maxStepsPerSecond));
    return {stepsPerSecond};
}

HapticFixture hapticOf(const SceneWorld& world, std::size_t fixture) {
    const FixtureDescription& now = world.fixtureNow(fixture);
    const Material& material = world.scene().materials[static_cast<std::size_t>(now.material)];
    return {material.frequencyHz, material.decayPerSecond, now.isCamera, world.bodyOf(fixture).massKg};
}

} // namespace

Simulation::Simulation(const Scene& scene, std::uint32_t seed, int stepsPerSecond)
    : clock_(checkedClock(scene, stepsPerSecond))
    , world_(scene, seed, clock_)
    , held_(heldEvents) {
    world_.world().SetContactListener(&catcher_);
    takeFixtures();
    takeMasses();
}

void Simulation::takeFixtures() {
    catcher_ = CollisionCatcher();
    for (std::size_t i = 0; i < world_.fixtureCount(); ++i) catcher_.add(world_.fixture(i), hapticOf(world_, i));
}

void Simulation::takeMasses() {
    const Scene& scene = world_.scene();
    const Normalisation& given = scene.normalisation;
    model_ = {given.secondsPerMetre.value_or(defaultNormalisation(scene.fieldWidthMetres)),
              given.handMassKg.value_or(world_.largestMassKg()), scene.driveGain};
}

void Simulation::step(std::vector<CollisionEvent>& finished) {
    const SceneChanges changes = world_.act(stepsDone_);
    if (changes.fixtures) takeFixtures();
    if (changes.bodies) takeMasses();
    const double stepSeconds = clock_.stepSeconds();
    catcher_.beginStep(stepSeconds);
    world_.world().Step(static_cast<float>(stepSeconds), velocityIterations, positionIterations);
    catcher_.collect(clock_, stepsDone_, model_, held_);
    ++stepsDone_;
    held_.release(settledNs(), finished);
}

} // namespace physvib
