// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the plug-in's user: scenes, layouts and sessions as an instance's state, presets, and the theme.
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
    std::string note; ///< a line for people: what of the file is not played here, or lowered; or empty
};

/// `state` with the scene or the layout of that file, or as a saved session left its desk, no louder than
/// `state` was (see lowerTo); one line if it is none of them or wrong. M only.
Result<OpenedFile> openFile(const std::filesystem::path& path, PluginState state);

/// The folder of user presets, which all instances list; each is a file with an instance's state:
/// `PhysVib/Presets` where programs of this system keep their data. It need not be there. M only.
inline juce::File presetFolder() {
    return juce::File::getSpecialLocation(juce::File::userApplicationDataDirectory)
        .getChildFile("PhysVib/Presets");
}

/// Its presets by their names. M only.
std::vector<juce::File> presetFiles(const juce::File& folder);

/// Writes `state` without the window's size, and its folder; empty, or one line with the reason. M only.
std::string savePreset(PluginState state, const juce::File& file);

/// What a person chose for the windows of all instances, in `PhysVib/look`; dark at first. M only.
Theme savedTheme();
void saveTheme(Theme theme);

} // namespace physvib
