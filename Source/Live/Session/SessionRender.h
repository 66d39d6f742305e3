// SPDX-License-Identifier: MIT
// Renders a saved session offline, to the samples that were played.
#pragma once
#include "Live/Documents/SessionFile.h"
#include "Live/Session/OfflineRender.h"
#include "Live/Session/SessionRecordings.h"
#include <cstdint>
#include <functional>

namespace physvib {

/// All events of the session before `endNs`, of its worlds and its inputs, in time order and without shaping.
/// Message thread (M) only. Throws what Simulation throws.
SceneEvents sessionEvents(const SavedSession& session, std::int64_t endNs, const StepWatch& keepGoing = {});

/// How much of a session is rendered, and a callback for the progress from 0 to 1, the first half of which is
/// the simulation; false cancels.
struct SessionExtent {
    int sampleRateHz = 48000;
    double seconds = 0.0; ///< the last scene run continues for as long as this takes
    std::function<bool(double)> progress;
};

/// Passes the session's samples to `consume`; false if it or `progress` has cancelled. M only. Throws what
/// Simulation throws.
bool renderSession(const SavedSession& session, const LoadedRecordings& recordings,
                   const SessionExtent& extent, const BlockConsumer& consume);

} // namespace physvib
