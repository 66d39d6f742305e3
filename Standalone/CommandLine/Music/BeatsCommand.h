// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib beats`: a song, felt: its onsets as strikes, or what of it actuators can render.
#pragma once
#include "CommandLine/Music/BeatOptions.h"
#include <string>

namespace physvib {

struct BeatsOptions {
    std::string music;
    std::string eventsPath, wavPath; ///< empty: not wanted
    bool isThrough = false;          ///< the WAV holds the music itself, low-passed
    std::string band;                ///< of that, in Hz; empty: the usual one
    std::string enchanters;          ///< of that; empty: all
    std::string layout = "phone4";
    BeatOptions beats;
};

void declareBeats(OptionTable& command, BeatsOptions& options);

/// An exit code.
int runBeats(const BeatsOptions& options);

} // namespace physvib
