// SPDX-License-Identifier: MIT
// Stepping a simulation until enough is settled.
#include "Scene/World/SceneRun.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>

namespace physvib {

SceneEvents runScene(const Scene& scene, const SceneRun& run, std::int64_t endNs, const StepWatch& goesOn) {
    const std::shared_ptr<const Scene> shared(&scene, [](const Scene*) {}); // the caller's, for this call
    const SceneTake take{0, 0, run.seed, shared, {}, {}};
    return runTakes({&take, 1}, run, endNs, goesOn);
}

SceneEvents runTakes(std::span<const SceneTake> takes, const SceneRun& run, std::int64_t endNs, const StepWatch& goesOn) {
    SceneEvents all;
    for (const SceneTake& take : takes) {
        Simulation world{take.whole(), take.seed, run.stepsPerSecond, run.timing, run.location};
        const bool isLast = &take == &takes.back();
        std::int64_t originNs = take.startNs;
        StallReader stalls{take.stalls};
        if (goesOn && !goesOn(originNs)) return all; // also building a world takes its time
        while (isLast ? originNs + world.settledNs() < endNs : world.timeNs() < take.worldEndNs) {
            originNs += stalls.lengthBefore(world.timeNs());
            const std::size_t before = all.events.size();
            world.step(all.events);
            for (std::size_t i = before; i < all.events.size(); ++i) all.events[i].timeNs += originNs;
            if (goesOn && !goesOn(originNs + world.timeNs())) return all;
        }
        all.drops += world.drops();
        all.counts += world.counts();
    }
    std::erase_if(all.events, [endNs](const CollisionEvent& e) { return e.timeNs >= endNs; });
    return all;
}

std::vector<BodyPose> posesAt(const Scene& scene, const SceneRun& run, std::int64_t timeNs) {
    std::vector<BodyPose> last;
    timeNs = std::max<std::int64_t>(timeNs, 0);
    followPoses(scene, run, std::max<std::int64_t>(timeNs, 1), timeNs + 1, [&](std::int64_t, std::span<const BodyPose> poses) {
        last.assign(poses.begin(), poses.end());
        return true;
    });
    return last;
}

void followPoses(const Scene& scene, const SceneRun& run, std::int64_t everyNs, std::int64_t endNs, const PoseWatch& see) {
    Simulation simulation{scene, run.seed, run.stepsPerSecond, run.timing, run.location};
    std::vector<CollisionEvent> unused;
    std::vector<BodyPose> poses(sceneCast(scene).size(), BodyPose{0.0, 0.0, 0.0, false});
    for (std::int64_t timeNs = 0; timeNs < endNs; timeNs += everyNs) {
        for (; simulation.timeNs() + 1'000'000'000 / run.stepsPerSecond <= timeNs; unused.clear()) simulation.step(unused);
        for (std::size_t i = 0; i < simulation.bodyCount(); ++i) poses[i] = simulation.pose(i);
        if (!see(timeNs, poses)) return;
    }
}

} // namespace physvib
