// SPDX-License-Identifier: MIT
// Loads the recordings and clips that a saved session refers to.
#pragma once
#include "Io/Result.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/SessionRender.h"
#include <string>
#include <vector>

namespace physvib {
/// Those of `log`; or one line if a file is missing, has changed or has no hit, or there are too many. M.
Result<LoadedRecordings> loadRecordings(const SessionLog& log);

/// Paths of these files. Any thread.
std::vector<std::string> recordingPaths(const SessionLog& log);

// Loads a recorded contact from a file: one channel, trimmed to the hit, at a defined level.

/// Time from the onset over which the strength of a contact is measured: long enough for most of a hit,
/// with little of its tail (assumed).
constexpr double matchedSeconds = 0.25;

/// The loudest channel of a recording from the onset of its strongest hit; or one line naming the file. The
/// peak is 1, like that of a mode's envelope; if `file.isMatched`, the RMS over matchedSeconds equals that of
/// the mode instead. A file whose hash differs from the expected one has changed and is refused. M only.
Result<ContactRecording> loadContact(const RecordingFile& file);

} // namespace physvib
