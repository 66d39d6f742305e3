// SPDX-License-Identifier: MIT
// Creates a scene's world and advances it step by step.
#include "Scene/World/Simulation.h"
#include "Scene/PartNames.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/BodyMass.h"
#include "Scene/World/SceneCast.h"
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

SceneEvents runScene(const Scene& scene, const RunSettings& run, std::int64_t endNs,
                     const StepWatch& keepGoing) {
    const std::shared_ptr<const Scene> shared(&scene, [](const Scene*) {}); // the caller's, for this call
    const SceneRun take{0, 0, run.seed, shared, {}, {}};
    return runTakes({&take, 1}, run, endNs, keepGoing);
}

SceneEvents runTakes(std::span<const SceneRun> takes, const RunSettings& run, std::int64_t endNs,
                     const StepWatch& keepGoing) {
    SceneEvents all;
    for (const SceneRun& take : takes) {
        const auto owned = std::make_unique<Simulation>(take.whole(), take.seed, run.stepsPerSecond,
                                                        run.timing, run.location);
        Simulation& world = *owned; // Box2D's has 100 kB, and the stack may be small
        const bool isLast = &take == &takes.back();
        std::int64_t originNs = take.startNs;
        StallReader stalls{take.stalls};
        if (keepGoing && !keepGoing(originNs)) return all; // building a world takes time, too
        while (isLast ? originNs + world.settledNs() < endNs : world.timeNs() < take.worldEndNs) {
            originNs += stalls.lengthBefore(world.timeNs());
            const std::size_t before = all.events.size();
            world.step(all.events);
            for (std::size_t i = before; i < all.events.size(); ++i) all.events[i].timeNs += originNs;
            if (keepGoing && !keepGoing(originNs + world.timeNs())) return all;
        }
        all.drops += world.drops();
        all.counts += world.counts();
    }
    std::erase_if(all.events, [endNs](const CollisionEvent& e) { return e.timeNs >= endNs; });
    return all;
}

WorldPoses posesAt(const Scene& scene, const RunSettings& run, std::int64_t timeNs) {
    WorldPoses last;
    timeNs = std::max<std::int64_t>(timeNs, 0);
    followPoses(scene, run, std::max<std::int64_t>(timeNs, 1), timeNs + 1,
                [&](std::int64_t, const WorldPoses& poses) {
                    last = poses;
                    return true;
                });
    return last;
}

namespace {

/// The world of a scene run, stepped along session time.
class FollowedTake {
public:
    FollowedTake(const SceneRun& take, const RunSettings& run, bool isLast)
        : scene_{take.whole()}
        , world_{scene_, take.seed, run.stepsPerSecond, run.timing, run.location}
        , stalls_{take.stalls}
        , originNs_{take.startNs + stalls_.lengthBefore(0)}
        , stepNs_{1'000'000'000 / run.stepsPerSecond}
        , endNs_{isLast ? INT64_MAX : take.worldEndNs}
        , poses_{std::vector<BodyPose>(sceneCast(scene_).size(), BodyPose{0.0, 0.0, 0.0, false}), {}} {}

    void moveTo(std::int64_t timeNs) {
        for (; world_.timeNs() < endNs_ && originNs_ + world_.timeNs() + stepNs_ <= timeNs; unused_.clear()) {
            world_.step(unused_);
            originNs_ += stalls_.lengthBefore(world_.timeNs());
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

void followTakes(std::span<const SceneRun> takes, const RunSettings& run, std::int64_t fromNs,
                 std::int64_t everyNs, std::int64_t endNs, const TakeWatch& see) {
    std::int64_t timeNs = fromNs;
    for (std::size_t i = 0; i < takes.size(); ++i) {
        const bool isLast = i + 1 == takes.size();
        const std::int64_t untilNs = isLast ? endNs : std::min(endNs, takes[i + 1].startNs);
        if (timeNs >= untilNs) continue;
        for (FollowedTake take{takes[i], run, isLast}; timeNs < untilNs; timeNs += everyNs) {
            take.moveTo(timeNs);
            if (!see(timeNs, take.scene(), take.poses())) return;
        }
    }
}

void followPoses(const Scene& scene, const RunSettings& run, std::int64_t everyNs, std::int64_t endNs,
                 const PoseWatch& see) {
    const std::shared_ptr<const Scene> shared(&scene, [](const Scene*) {}); // the caller's, for this call
    const SceneRun take{0, 0, run.seed, shared, {}, {}};
    followTakes(
        {&take, 1}, run, 0, everyNs, endNs,
        [&](std::int64_t timeNs, const Scene&, const WorldPoses& poses) { return see(timeNs, poses); });
}

} // namespace physvib
