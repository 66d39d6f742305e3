// SPDX-License-Identifier: MIT
// Builds a scene's world and advances it step by step.
#include "Physics/Simulation.h"
#include "Physics/SceneBodies.h"
#include "Physics/SceneValidation.h"
#include <random>
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

b2Vec2 vectorOf(const GravityInput& input) {
    return {static_cast<float>(input.xMetresPerSecond2), static_cast<float>(input.yMetresPerSecond2)};
}

HapticFixture hapticOf(const BodyDescription& body, const Scene& scene) {
    const Material& material = scene.materials[static_cast<std::size_t>(body.material)];
    return {material.frequencyHz, material.decayPerSecond, body.isCamera, body.staticMassKg};
}

} // namespace

Simulation::Simulation(const Scene& scene, std::uint32_t seed, int stepsPerSecond)
    : clock_(checkedClock(scene, stepsPerSecond))
    , script_(scene, clock_)
    , held_(heldEvents)
    , world_(vectorOf(script_.at(0))) {
    world_.SetContactListener(&catcher_);
    build(scene, seed);
    model_ = {defaultNormalisation(scene.fieldWidthMetres), catcher_.largestMassKg(), scene.driveGain};
}

void Simulation::build(const Scene& scene, std::uint32_t seed) {
    std::mt19937 random(seed);
    // Box2D adds a whole step of gravity before it moves a body, which is half a step too early. Velocities
    // that start half a step behind make this the leapfrog scheme: bodies fall along the exact parabola.
    const b2Vec2 halfStep = static_cast<float>(-0.5 * clock_.stepSeconds()) * world_.GetGravity();
    for (const BodyDescription& description : scene.bodies) {
        const bool moves = seed != 0 && !description.isStatic;
        const StartJitter jitter = moves ? drawJitter(random) : StartJitter{};
        b2Fixture& fixture = createBody(world_, scene, description, jitter, clock_.stepSeconds());
        catcher_.add(fixture, hapticOf(description, scene));
        bodies_.push_back(fixture.GetBody());
        bodies_.back()->SetLinearVelocity(bodies_.back()->GetLinearVelocity() + halfStep);
    }
}

void Simulation::step(std::vector<CollisionEvent>& finished) {
    applyGravity();
    const double stepSeconds = clock_.stepSeconds();
    catcher_.beginStep(stepSeconds);
    world_.Step(static_cast<float>(stepSeconds), velocityIterations, positionIterations);
    catcher_.collect(clock_, stepsDone_, model_, held_);
    ++stepsDone_;
    held_.release(settledNs(), finished);
}

void Simulation::applyGravity() {
    const b2Vec2 gravity = vectorOf(script_.at(stepsDone_));
    if (gravity == world_.GetGravity()) return;
    world_.SetGravity(gravity);
    for (b2Body* body : bodies_) body->SetAwake(true); // sleeping bodies would not notice
}

BodyPose Simulation::pose(std::size_t index) const noexcept {
    const b2Body& body = *bodies_[index];
    return {body.GetPosition().x, body.GetPosition().y, body.GetAngle()};
}

} // namespace physvib
