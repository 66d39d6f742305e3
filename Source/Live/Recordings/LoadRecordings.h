// SPDX-License-Identifier: MIT
// Loads the recordings and clips that a saved session refers to, and clips by name.
#pragma once
#include "Io/Result.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/SessionRender.h"
#include <filesystem>
#include <string>
#include <vector>

namespace physvib {

/// Loads the recordings of `log`. An error if a file is missing, has changed or has no hit, or too many. M.
Result<LoadedRecordings> loadRecordings(const SessionLog& log);

/// Paths of these files. Any thread.
std::vector<std::string> recordingPaths(const SessionLog& log);

// Loads a recorded contact from a file: one channel, trimmed to the hit, at a defined level.

/// Time from the onset over which the strength of a contact is measured: long enough for most of a hit,
/// with little of its tail (assumed).
constexpr double matchWindowSeconds = 0.25;

/// The loudest channel of a recording from the onset of its strongest hit; or one line naming the file. The
/// peak is 1, like that of a mode's envelope; if `file.isMatched`, the RMS over matchWindowSeconds equals
/// that of the mode instead. A file whose hash differs from the expected one has changed and is refused. M
/// only.
Result<ContactRecording> loadContact(const RecordingFile& file);

// Loads clips by name from one folder, so that a message can only read files below it.

/// Loads the clips of messages (a ClipSource). Any thread but R.
class ClipFolder {
public:
    explicit ClipFolder(std::filesystem::path folder)
        : folder_{std::move(folder)} {}

    /// Loads a recording or a haptic file (see readRecording), which must be in the folder or below after all
    /// links are followed. Returns the error in one line otherwise.
    Result<LoadedClip> operator()(const std::string& name) const;

private:
    std::filesystem::path folder_;
};

/// All channels of that file, without content below 5 Hz (removeSlowPart). Any thread but R.
Result<LoadedClip> loadWholeClip(const std::filesystem::path& path);

/// The clips that a session refers to; or one line if a file is missing or has changed. Any thread but R.
Result<std::vector<ContactRecording>> loadSessionClips(const std::vector<ClipFile>& clips);

} // namespace physvib
