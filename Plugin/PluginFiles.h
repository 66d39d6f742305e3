// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the user: scenes, layouts, sessions and presets are read as a state; presets and theme are
// written.
#pragma once
#include "Host/Views/Look.h"
#include "Io/Result.h"
#include "Live/Documents/PluginState.h"
#include <filesystem>
#include <juce_core/juce_core.h>
#include <string>
#include <vector>

namespace physvib {

struct OpenedFile {
    PluginState state;
    std::string note; ///< a line for the user: what is not played here or was lowered; empty: nothing
};

/// `state` with the scene, layout, session or preset of that file, no louder than `state` was (see
/// lowerToLimits()); else a one-line error. M only.
Result<OpenedFile> openFile(const std::filesystem::path& path, PluginState state);

/// The folder of user presets, one file with a state each, which all instances list. It may not exist. M
/// only.
inline juce::File presetFolder() {
    return juce::File::getSpecialLocation(juce::File::userApplicationDataDirectory)
        .getChildFile("PhysVib/Presets");
}

/// The folder's preset files, sorted by name. M only.
std::vector<juce::File> presetFiles(const juce::File& folder);

/// Writes `state` without the window's size, and creates the folder; empty, or a one-line error. M only.
std::string savePreset(PluginState state, const juce::File& file);

/// The user's theme for the windows of all instances, in `PhysVib/look`; dark at first. M only.
Theme savedTheme();
void saveTheme(Theme theme);

} // namespace physvib
