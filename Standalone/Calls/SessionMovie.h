// SPDX-License-Identifier: GPL-3.0-or-later
// Exports the last part of a session as a movie.
#pragma once
#include "Live/Documents/SessionFile.h"
#include "System/Process.h"
#include <functional>
#include <string>

namespace physvib {

constexpr double longestMovieSeconds = 600.0; ///< limits memory and disk space for pictures

/// The ending of a movie with sound, if this computer can write one, else of one without. Any thread but R.
inline std::string movieEnding() { return hasProgram("ffmpeg") ? ".mp4" : ".webp"; }

/// Writes a movie of the last `seconds` of the session, with all its scene runs and impacts in order
/// and the output of the actuators of `layout`; an .mp4 also has the sound of each contact, left and right,
/// as the mixer's monitor plays it at its usual level. The file appears complete or not at all. `progress`
/// gets shares of 0 to 1 and cancels by returning false. Returns an empty string or one error line,
/// "cancelled" if so. Any thread but the render thread.
std::string writeSessionMovie(const SavedSession& session, const LayoutDescription& layout, double seconds,
                              const std::string& path, const std::function<bool(double)>& progress);

} // namespace physvib
