// SPDX-License-Identifier: MIT
// Stepping a simulation until enough is settled.
#include "Physics/SceneRun.h"
#include "Physics/SceneCast.h"
#include <algorithm>

namespace physvib {

SceneEvents runScene(const Scene& scene, const SceneRun& run, std::int64_t endNs) {
    Simulation simulation{scene, run.seed, run.stepsPerSecond, run.timing, run.location};
    SceneEvents all;
    while (simulation.settledNs() < endNs) simulation.step(all.events);
    const auto isBefore = [endNs](const CollisionEvent& e) { return e.timeNs < endNs; };
    all.events.erase(std::partition_point(all.events.begin(), all.events.end(), isBefore), all.events.end());
    all.drops = simulation.drops();
    return all;
}

std::vector<BodyPose> posesAt(const Scene& scene, const SceneRun& run, std::int64_t timeNs) {
    Simulation simulation{scene, run.seed, run.stepsPerSecond, run.timing, run.location};
    std::vector<CollisionEvent> unused;
    while (simulation.timeNs() + 1'000'000'000 / run.stepsPerSecond <= timeNs) simulation.step(unused);
    std::vector<BodyPose> poses(sceneCast(scene).size(), BodyPose{0.0, 0.0, 0.0, false});
    for (std::size_t i = 0; i < simulation.bodyCount(); ++i) poses[i] = simulation.pose(i);
    return poses;
}

} // namespace physvib
