// SPDX-License-Identifier: MIT
// What hands did in a scene run, as the script of the scene: recorded, trimmed, and felt again by a render.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneTake.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// Inputs of hands in time order, in seconds of the world since its start.
struct HandScript {
    std::vector<LiveInput> inputs;
    double lengthSeconds = 0.0;
    bool operator==(const HandScript&) const = default;
};

/// Which part of a recording becomes the script.
struct ScriptTrim {
    double fromSeconds = 0.0, toSeconds = 0.0;
    bool repeats = false;
    bool operator==(const ScriptTrim&) const = default;
};

/// The scene that hands are recorded in: without what its script does of what hands do (sceneForHands), and
/// without a period if nothing is left of the script. Any thread.
Scene sceneToRecord(const Scene& scene);

/// How long a recording in that scene may be, in s: its script's period, as what is left of the script goes
/// on with the recording. Any thread.
double maxRecordedSeconds(const Scene& recordedIn);

/// How many inputs a recording in that scene may have: as many as a script may, without those of the scene.
/// Any thread.
std::size_t maxRecordedInputs(const Scene& recordedIn);

/// What hands did: from the start of the take to its end, or to the first edit of the scene, or to
/// maxRecordedInputs(). Any thread.
HandScript recordedHands(const SceneTake& take);

/// The part between two times. How the device was held and what was driven before it is so from its start; a
/// grip that is open at its end lets go there. The world is at the scene's start when it begins. Any thread.
HandScript trimmed(const Scene& recordedIn, const HandScript& hands, const ScriptTrim& trim);

/// The scene that hands were recorded in, with the trimmed recording as its script. From the beginning of the
/// recording its events are those of the take, to the bit, at the same seed and step rate (but for an input
/// of its very first step, which a script does before it). Any thread.
Scene withHands(Scene recordedIn, const HandScript& hands, const ScriptTrim& trim);

} // namespace physvib
