// SPDX-License-Identifier: GPL-3.0-or-later
// User presets: a file each with an instance's state, in a folder that all instances list. Also stores window
// settings.
#pragma once
#include "Host/Views/Look.h"
#include "Live/Documents/PluginState.h"
#include <juce_core/juce_core.h>
#include <string>
#include <vector>

namespace physvib {

/// `PhysVib/Presets` where programs of this system keep their data. It need not be there. M only.
inline juce::File presetFolder() {
    return juce::File::getSpecialLocation(juce::File::userApplicationDataDirectory)
        .getChildFile("PhysVib/Presets");
}

/// Its presets by their names. M only.
std::vector<juce::File> presetFiles(const juce::File& folder);

/// Writes `state` without the window's size, and makes the folder if it is missing; empty, or one line with
/// the reason. M only.
std::string savePreset(PluginState state, const juce::File& file);

/// What a person chose for the windows of all instances, in `PhysVib/look`; dark at first. M only.
Ground savedGround();
void saveGround(Ground ground);

} // namespace physvib
