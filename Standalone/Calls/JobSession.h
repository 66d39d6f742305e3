// SPDX-License-Identifier: GPL-3.0-or-later
// A job that is played live instead: the session that it becomes.
#pragma once
#include "Calls/LoadedRender.h"
#include "Live/Session/SessionSetup.h"
#include <vector>

namespace physvib {

/// What the scene's materials sound like: which of them meet, nobody knows yet.
inline std::vector<CollisionEvent> soundsOf(const Scene& scene) {
    std::vector<CollisionEvent> sounds;
    for (const Material& m : scene.materials) {
        if (!(m.frequencyHz > 0.0)) continue;
        CollisionEvent& sound = sounds.emplace_back();
        sound.frequencyHz = m.frequencyHz;
        sound.decayPerSecond = m.decayPerSecond;
        sound.sound = soundOfMaterial(m.name);
    }
    return sounds;
}

/// A job with a scene, as a session plays it.
inline SessionSetup sessionSetup(const LoadedRender& job) {
    SessionSetup setup;
    setup.scene = *job.scene;
    const SceneRun run = job.run();
    setup.seed = run.seed;
    setup.stepsPerSecond = run.stepsPerSecond;
    setup.timing = run.timing;
    setup.location = run.location;
    setup.channels = job.channels();
    setup.panner = job.panner();
    setup.equalised = job.equalised();
    setup.shaping = job.shaping();
    setup.recordings = job.feltRecordings();
    setup.limiterEnabled = job.options.isLimited;
    return setup;
}

} // namespace physvib
