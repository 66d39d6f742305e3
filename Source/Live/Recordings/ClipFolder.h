// SPDX-License-Identifier: MIT
// Loads clips by name from one folder, so that a message can only read files below it.
#pragma once
#include "Live/Documents/SessionLog.h"
#include "Live/Messages/MessageRouter.h"
#include <filesystem>
#include <string>
#include <vector>

namespace physvib {

/// A ClipSource. Any thread but R.
class ClipFolder {
public:
    explicit ClipFolder(std::filesystem::path folder)
        : folder_{std::move(folder)} {}

    /// Loads a recording or a haptic file (see readRecording), which must be in the folder or below after all
    /// links are followed. Or one line.
    Result<LoadedClip> operator()(const std::string& name) const;

private:
    std::filesystem::path folder_;
};

/// All channels of that file, without content below 5 Hz (takeSlowPart). Any thread but R.
Result<LoadedClip> loadWholeClip(const std::filesystem::path& path);

/// The clips that a session refers to; or one line if a file is missing or has changed. Any thread but R.
Result<std::vector<ContactRecording>> loadKeptClips(const std::vector<ClipFile>& clips);

} // namespace physvib
