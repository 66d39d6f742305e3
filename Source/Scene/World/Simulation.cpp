// SPDX-License-Identifier: MIT
// Creates a scene's world and advances it step by step.
#include "Scene/World/Simulation.h"
#include "Scene/PartNames.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/BodyMass.h"
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace physvib {

namespace {

// Box2D's recommended numbers of iterations.
constexpr int velocityIterations = 8;
constexpr int positionIterations = 3;

StepClock checkedClock(const Scene& scene, int stepsPerSecond) {
    if (const std::string fault = validate(scene); !fault.empty()) throw std::invalid_argument(fault);
    if (stepsPerSecond < Simulation::minStepsPerSecond || stepsPerSecond > Simulation::maxStepsPerSecond)
        throw std::invalid_argument("steps per second: expected " +
                                    std::to_string(Simulation::minStepsPerSecond) + " to " +
                                    std::to_string(Simulation::maxStepsPerSecond));
    return {stepsPerSecond};
}

ImpactSettings settingsOf(const Scene& scene, ImpactTiming timing, ImpactLocation location) {
    ImpactSettings settings;
    settings.fieldWidthMetres = scene.fieldWidthMetres;
    settings.normalisation = scene.normalisation.secondsPerMetre;
    settings.handMassKg = scene.normalisation.handMassKg;
    settings.driveGain = scene.driveGain;
    settings.timing = timing;
    settings.location = location;
    return settings;
}

HapticFixture hapticOf(const Scene& scene, const SceneWorld::FixtureNow& now) {
    // a control may have removed the decay
    const bool isSilent = isEndless(now.material.frequencyHz, now.material.decayPerSecond);
    HapticFixture values{
        isSilent ? 0.0 : now.material.frequencyHz, now.material.decayPerSecond, now.description.isCamera,
        now.description.isCamera ? massKg(now.body, scene) : now.body.massKg, now.description.voice};
    values.texture = now.material.texture();
    values.sound = soundOfMaterial(now.material.name);
    values.part = partOf(now.description.part);
    return values;
}

} // namespace

Simulation::Simulation(const Scene& scene, std::uint32_t seed, int stepsPerSecond, ImpactTiming timing,
                       ImpactLocation location)
    : clock_(checkedClock(scene, stepsPerSecond))
    , world_(scene, seed, clock_)
    , attachment_(world_.world(), settingsOf(scene, timing, location)) {
    takeFixtures();
}

void Simulation::takeFixtures() {
    world_.forAllFixtures([this](const SceneWorld::FixtureNow& now) {
        (void)attachment_.set(now.fixture, hapticOf(scene(), now), static_cast<std::int32_t>(now.number));
    });
}

void Simulation::addInput(double timeSeconds, Action action) {
    world_.addInput(std::max(clock_.firstStepAt(timeSeconds), stepsDone_), std::move(action));
}

void Simulation::step(std::vector<CollisionEvent>& finished) {
    if (world_.act(stepsDone_)) takeFixtures();
    ++stepsDone_;
    attachment_.beginStepUntil(timeNs());
    world_.world().Step(static_cast<float>(clock_.stepSeconds()), velocityIterations, positionIterations);
    attachment_.endStep();
    attachment_.take(finished);
}

} // namespace physvib
