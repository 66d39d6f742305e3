// SPDX-License-Identifier: MIT
// Records a user's inputs in a scene run, trims them, and stores them as the scene's script.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneEdits.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// User inputs in time order, in seconds of the world since its start.
struct HandScript {
    std::vector<LiveInput> inputs;
    double lengthSeconds = 0.0;
    bool operator==(const HandScript&) const = default;
};

/// The part of a recording that becomes the script.
struct ScriptTrim {
    double fromSeconds = 0.0, toSeconds = 0.0;
    bool repeats = false;
    bool operator==(const ScriptTrim&) const = default;
};

/// The scene in which inputs are recorded: without scripted user input (sceneForHands), and without a period
/// if the script is then empty. Any thread.
Scene sceneToRecord(const Scene& scene);

/// Maximum length of a recording in that scene, in s: the period of the remaining script, which continues
/// with the recording. Any thread.
double maxRecordedSeconds(const Scene& recordedIn);

/// Maximum number of inputs of a recording: a script's limit, less the scene's own. Any thread.
std::size_t maxRecordedInputs(const Scene& recordedIn);

/// The user's inputs from the start of the scene run to its end, the first edit of the scene, or
/// maxRecordedInputs(). Any thread.
HandScript recordedHands(const SceneRun& take);

/// The part between two times. It starts with the device orientation and drives that were set before; a grip
/// still open at its end is released there. The world starts at the scene's start. Any thread.
HandScript trimmed(const Scene& recordedIn, const HandScript& hands, const ScriptTrim& trim);

/// The scene with the trimmed recording as its script. If trimmed from the recording's beginning, its events
/// equal those of the scene run to the bit, at the same seed and step rate (except for an input in the very
/// first step, which a script executes before it). Any thread.
Scene withHands(Scene recordedIn, const HandScript& hands, const ScriptTrim& trim);

} // namespace physvib
