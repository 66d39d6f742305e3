// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a user's file (scene, layout, or session with its mixer state) as the state of a plug-in instance.
#pragma once
#include "Io/Result.h"
#include "Live/Documents/PluginState.h"
#include <filesystem>
#include <string>

namespace physvib {

struct OpenedFile {
    PluginState state;
    std::string note; ///< a line for people on what of the file is not played here, or lowered; empty:
                      ///< nothing
};

/// `state` with the scene or the layout of that file, or as a saved session left its desk, no louder than
/// `state` was (see lowerTo); one line if it is none of them or wrong. M only.
Result<OpenedFile> openFile(const std::filesystem::path& path, PluginState state);

} // namespace physvib
