// SPDX-License-Identifier: MIT
// A saved session to samples again, faster than it was played.
#pragma once
#include "Live/Documents/SessionFile.h"
#include "Live/Session/OfflineRender.h"
#include "Live/Session/SessionRecordings.h"
#include <cstdint>
#include <functional>

namespace physvib {

/// All that was struck in the session before `endNs`, in time order, not shaped yet: by its worlds, and apart
/// from them. M only. Throws what Simulation throws.
SceneEvents sessionEvents(const SavedSession& session, std::int64_t endNs, const StepWatch& goesOn = {});

/// How much of a session is rendered, and who is told shares of 0 to 1, the first half of which is the world;
/// false cancels.
struct SessionExtent {
    int sampleRateHz = 48000;
    double seconds = 0.0; ///< the world of the last take goes on for as long as it takes
    std::function<bool(double)> progress;
};

/// The session's samples, to `consume`; false if it or `progress` has cancelled. M only. Throws what
/// Simulation throws.
bool renderSession(const SavedSession& session, const LoadedRecordings& recordings,
                   const SessionExtent& extent, const BlockConsumer& consume);

} // namespace physvib
