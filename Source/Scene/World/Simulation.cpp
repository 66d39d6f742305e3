// SPDX-License-Identifier: MIT
// Steps a scene's world and collects its events; repeats scene runs offline, for their events or their poses.
#include "Scene/World/Simulation.h"
#include "Scene/PartNames.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/BodyLists.h"
#include "Scene/World/BodyMass.h"
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace physvib {

namespace {

// Box2D's recommended numbers of iterations.
constexpr int velocityIterations = 8;
constexpr int positionIterations = 3;

StepClock makeClock(const Scene& scene, int stepsPerSecond) {
    if (const std::string error = validate(scene); !error.empty()) throw std::invalid_argument(error);
    if (stepsPerSecond < Simulation::minStepsPerSecond || stepsPerSecond > Simulation::maxStepsPerSecond)
        throw std::invalid_argument("steps per second: expected " +
                                    std::to_string(Simulation::minStepsPerSecond) + " to " +
                                    std::to_string(Simulation::maxStepsPerSecond));
    return {stepsPerSecond};
}

ImpactSettings makeSettings(const Scene& scene, ImpactTiming timing, ImpactLocation location) {
    ImpactSettings settings;
    settings.fieldWidthMetres = scene.fieldWidthMetres;
    settings.normalisation = scene.normalisation.secondsPerMetre;
    settings.handMassKg = scene.normalisation.handMassKg;
    settings.driveGain = scene.driveGain;
    settings.timing = timing;
    settings.location = location;
    return settings;
}

HapticFixture makeHapticFixture(const Scene& scene, const SceneWorld::CurrentFixture& current) {
    // a sound action may have removed the decay, so that the sound would never end
    const bool isSilent = isEndless(current.material.frequencyHz, current.material.decayPerSecond);
    HapticFixture values{isSilent ? 0.0 : current.material.frequencyHz, current.material.decayPerSecond,
                         current.description.isCamera,
                         current.description.isCamera ? massKg(current.body, scene) : current.body.massKg,
                         current.description.voice};
    values.texture = current.material.texture();
    values.sound = soundOfMaterial(current.material.name);
    values.part = toPartNumber(current.description.part);
    return values;
}

} // namespace

Simulation::Simulation(const Scene& scene, std::uint32_t seed, int stepsPerSecond, ImpactTiming timing,
                       ImpactLocation location)
    : clock_(makeClock(scene, stepsPerSecond))
    , world_(scene, seed, clock_)
    , attachment_(world_.world(), makeSettings(scene, timing, location)) {
    updateFixtures();
}

void Simulation::updateFixtures() {
    world_.forEachFixture([this](const SceneWorld::CurrentFixture& current) {
        (void)attachment_.set(current.fixture, makeHapticFixture(scene(), current),
                              static_cast<std::int32_t>(current.number));
    });
}

void Simulation::addInput(double timeSeconds, Action action) {
    world_.addInput(std::max(clock_.firstStepAt(timeSeconds), stepsDone_), std::move(action));
}

void Simulation::step(std::vector<CollisionEvent>& finished) {
    if (world_.executeActions(stepsDone_)) updateFixtures();
    ++stepsDone_;
    attachment_.beginStepUntil(timeNs());
    world_.world().Step(static_cast<float>(clock_.stepSeconds()), velocityIterations, positionIterations);
    attachment_.endStep();
    attachment_.take(finished);
}

SceneEvents simulateScene(const Scene& scene, const RunSettings& settings, std::int64_t endNs,
                          const StepWatch& keepGoing) {
    const std::shared_ptr<const Scene> shared(&scene, [](const Scene*) {}); // not owned: `scene` outlives it
    const SceneRun sceneRun{0, 0, settings.seed, shared, {}, {}};
    return simulateRuns({&sceneRun, 1}, settings, endNs, keepGoing);
}

SceneEvents simulateRuns(std::span<const SceneRun> runs, const RunSettings& settings, std::int64_t endNs,
                         const StepWatch& keepGoing) {
    SceneEvents result;
    for (const SceneRun& sceneRun : runs) {
        const auto owned = std::make_unique<Simulation>(
            sceneRun.fullScene(), sceneRun.seed, settings.stepsPerSecond, settings.timing, settings.location);
        Simulation& world = *owned; // on the heap: 100 kB are too much for a small stack
        const bool isLast = &sceneRun == &runs.back();
        std::int64_t originNs = sceneRun.startNs;
        StallReader stalls{sceneRun.stalls};
        if (keepGoing && !keepGoing(originNs)) return result; // building a world takes long
        while (isLast ? originNs + world.settledNs() < endNs : world.timeNs() < sceneRun.worldEndNs) {
            originNs += stalls.delayNsBefore(world.timeNs());
            const std::size_t before = result.events.size();
            world.step(result.events);
            for (std::size_t i = before; i < result.events.size(); ++i) result.events[i].timeNs += originNs;
            if (keepGoing && !keepGoing(originNs + world.timeNs())) return result;
        }
        result.drops += world.drops();
        result.counts += world.counts();
    }
    std::erase_if(result.events, [endNs](const CollisionEvent& e) { return e.timeNs >= endNs; });
    return result;
}

WorldPoses posesAt(const Scene& scene, const RunSettings& settings, std::int64_t timeNs) {
    WorldPoses last;
    timeNs = std::max<std::int64_t>(timeNs, 0);
    followPoses(scene, settings, std::max<std::int64_t>(timeNs, 1), timeNs + 1,
                [&](std::int64_t, const WorldPoses& poses) {
                    last = poses;
                    return true;
                });
    return last;
}

namespace {

/// The world of a scene run, stepped along session time.
class FollowedRun {
public:
    FollowedRun(const SceneRun& sceneRun, const RunSettings& settings, bool isLast)
        : scene_{sceneRun.fullScene()}
        , world_{scene_, sceneRun.seed, settings.stepsPerSecond, settings.timing, settings.location}
        , stalls_{sceneRun.stalls}
        , originNs_{sceneRun.startNs + stalls_.delayNsBefore(0)}
        , stepNs_{1'000'000'000 / settings.stepsPerSecond}
        , endNs_{isLast ? INT64_MAX : sceneRun.worldEndNs}
        , poses_{std::vector<BodyPose>(allBodies(scene_).size(), BodyPose{0.0, 0.0, 0.0, false}), {}} {}

    void moveTo(std::int64_t timeNs) {
        for (; world_.timeNs() < endNs_ && originNs_ + world_.timeNs() + stepNs_ <= timeNs; unused_.clear()) {
            world_.step(unused_);
            originNs_ += stalls_.delayNsBefore(world_.timeNs());
        }
        for (std::size_t i = 0; i < world_.bodyCount(); ++i) poses_.bodies[i] = world_.pose(i);
        poses_.joints = world_.jointPoses();
    }
    const Scene& scene() const noexcept { return scene_; }
    const WorldPoses& poses() const noexcept { return poses_; }

private:
    const Scene scene_;
    Simulation world_;
    StallReader stalls_;
    std::int64_t originNs_;
    const std::int64_t stepNs_, endNs_;
    WorldPoses poses_;
    std::vector<CollisionEvent> unused_;
};

} // namespace

void followRuns(std::span<const SceneRun> runs, const RunSettings& settings, std::int64_t fromNs,
                std::int64_t everyNs, std::int64_t endNs, const RunPoseWatch& watch) {
    std::int64_t timeNs = fromNs;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const bool isLast = i + 1 == runs.size();
        const std::int64_t untilNs = isLast ? endNs : std::min(endNs, runs[i + 1].startNs);
        if (timeNs >= untilNs) continue;
        for (FollowedRun sceneRun{runs[i], settings, isLast}; timeNs < untilNs; timeNs += everyNs) {
            sceneRun.moveTo(timeNs);
            if (!watch(timeNs, sceneRun.scene(), sceneRun.poses())) return;
        }
    }
}

void followPoses(const Scene& scene, const RunSettings& settings, std::int64_t everyNs, std::int64_t endNs,
                 const PoseWatch& watch) {
    const std::shared_ptr<const Scene> shared(&scene, [](const Scene*) {}); // not owned: `scene` outlives it
    const SceneRun sceneRun{0, 0, settings.seed, shared, {}, {}};
    followRuns(
        {&sceneRun, 1}, settings, 0, everyNs, endNs,
        [&](std::int64_t timeNs, const Scene&, const WorldPoses& poses) { return watch(timeNs, poses); });
}

} // namespace physvib
