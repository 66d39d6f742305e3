// SPDX-License-Identifier: GPL-3.0-or-later
// Clips by their names below one folder: what a message may have read.
#pragma once
#include "Live/Documents/SessionLog.h"
#include "Live/Messages/ClipSource.h"
#include <filesystem>
#include <string>
#include <vector>

namespace physvib {

/// A ClipSource. Any thread but R.
class ClipFolder {
public:
    explicit ClipFolder(std::filesystem::path folder)
        : folder_{std::move(folder)} {}

    /// A recording or a haptic file (see readRecording) in the folder or below, wherever links lead; or one
    /// line.
    Result<LoadedClip> operator()(const std::string& name) const;

private:
    std::filesystem::path folder_;
};

/// All channels of that file, without what lies below 5 Hz (takeSlowPart). Any thread but R.
Result<LoadedClip> loadWholeClip(const std::filesystem::path& path);

/// The channels that a session has kept; or one line: a file is missing or has changed. Any thread but R.
Result<std::vector<ContactRecording>> loadKeptClips(const std::vector<ClipFile>& clips);

} // namespace physvib
