// SPDX-License-Identifier: GPL-3.0-or-later
// The recordings and clips of a saved session, loaded again.
#pragma once
#include "Io/Result.h"
#include "Live/Session/SessionRecordings.h"
#include <string>
#include <vector>

namespace physvib {

/// Those of `log`; or one line: a file is missing, has changed, or is no hit, or they are too many. M only.
Result<LoadedRecordings> loadRecordings(const SessionLog& log);

/// Where they are. Any thread.
std::vector<std::string> recordingPaths(const SessionLog& log);

} // namespace physvib
