// SPDX-License-Identifier: GPL-3.0-or-later
// A saved session to samples again, faster than it was played.
#pragma once
#include "Files/SessionFile.h"
#include <cstdint>
#include <functional>
#include <string>

namespace physvib {

/// All that was struck in the session before `endNs`, in time order, not shaped yet: by its worlds, and apart from them. M only. Throws
/// what Simulation throws.
SceneEvents sessionEvents(const SavedSession& session, std::int64_t endNs, const StepWatch& goesOn = {});

/// Renders `seconds` of the session to a WAV file that appears whole or not at all; the world of the last take goes on for
/// as long as it takes. `progress` is told shares of 0 to 1, the first half of which is the world; it says false to cancel. Empty, or one line with the reason;
/// "cancelled". Any thread but R.
std::string renderSession(const SavedSession& session, const std::string& path, int sampleRateHz, double seconds, const std::string& comment,
                          const std::function<bool(double)>& progress);

} // namespace physvib
