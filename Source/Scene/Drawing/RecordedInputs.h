// SPDX-License-Identifier: MIT
// Takes the user's inputs from a scene run, trims them, and makes them the scene's script.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneEdits.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// User inputs in time order; times are seconds of world time since the start.
struct RecordedInputs {
    std::vector<LiveInput> inputs;
    double lengthSeconds = 0.0;
    bool operator==(const RecordedInputs&) const = default;
};

/// The part of a recording that becomes the script.
struct ScriptTrim {
    double fromSeconds = 0.0, toSeconds = 0.0;
    bool repeats = false;
    bool operator==(const ScriptTrim&) const = default;
};

/// The scene in which inputs are recorded: without scripted user input (sceneForUserInput), and without a
/// period if the script is then empty. Any thread.
Scene sceneToRecord(const Scene& scene);

/// Maximum length of a recording in that scene, in s: the period of the remaining script, which continues
/// with the recording. Any thread.
double maxRecordedSeconds(const Scene& recordedScene);

/// Maximum number of inputs of a recording: a script's limit, less the scene's own. Any thread.
std::size_t maxRecordedInputs(const Scene& recordedScene);

/// The user's inputs from the start of the scene run to its end, at most to the first edit of the scene and
/// at most maxRecordedInputs(). Any thread.
RecordedInputs recordedInputs(const SceneRun& run);

/// The part between two times, from 0. It begins with the device orientation and drives that were set
/// earlier; a grip that is open at its end is released there. Bodies start as in the scene. Any thread.
RecordedInputs trimmedInputs(const Scene& recordedScene, const RecordedInputs& recording,
                             const ScriptTrim& trim);

/// The scene with the trimmed recording as its script. If trimmed from the recording's beginning, its events
/// equal those of the scene run to the bit, at the same seed and step rate (except for an input in the very
/// first step, which a script executes before it). Any thread.
Scene sceneWithInputs(Scene recordedScene, const RecordedInputs& recording, const ScriptTrim& trim);

} // namespace physvib
