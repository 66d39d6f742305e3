// SPDX-License-Identifier: MIT
// Loads the recordings and clips that a saved session refers to.
#pragma once
#include "Io/Result.h"
#include "Live/Session/SessionRecordings.h"
#include <string>
#include <vector>

namespace physvib {

/// Those of `log`; or one line if a file is missing, has changed or has no hit, or if there are too many. M
/// only.
Result<LoadedRecordings> loadRecordings(const SessionLog& log);

/// Paths of these files. Any thread.
std::vector<std::string> recordingPaths(const SessionLog& log);

} // namespace physvib
