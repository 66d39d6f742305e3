// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a render job to the setup of a live session.
#pragma once
#include "Calls/LoadedRender.h"
#include "Live/Session/SessionSetup.h"
#include <vector>

namespace physvib {

/// One event per material with a frequency. In a live session any material may collide, so all of them count.
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

/// Session setup of a job with a scene.
inline SessionSetup sessionSetup(const LoadedRender& job) {
    SessionSetup setup;
    setup.scene = *job.scene;
    const RunSettings run = job.run();
    setup.seed = run.seed;
    setup.stepsPerSecond = run.stepsPerSecond;
    setup.timing = run.timing;
    setup.location = run.location;
    setup.channels = job.channels();
    setup.panner = job.panner();
    setup.layout = job.layout;
    setup.equalised = job.equalised();
    setup.shaping = job.shaping();
    setup.recordings = job.feltRecordings();
    setup.limiterEnabled = job.options.limiting == Limiting::on;
    setup.normalisesBlocks = job.options.limiting == Limiting::blocks;
    return setup;
}

} // namespace physvib
