// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a sound file on the actuators, as a clip in a session without bodies, with the session's safety
// limits.
#pragma once
#include "Calls/LoadedRender.h"
#include "CommandLine/Play/LivePlay.h"
#include "Live/Messages/MessageRouter.h"
#include <string>
#include <string_view>

namespace physvib {

/// True if the name has an extension of a recording or a haptic file.
bool namesSound(std::string_view file);

/// Reads the sound file given as scene. Sets a scene without bodies in `job`; sets the file's duration and a
/// layout with one actuator per channel in `options`, unless given. Or one error line. Message thread.
Result<LoadedClip> takeSound(RenderJob& options, std::string_view device, LoadedRender& job);

/// Empty, or an error if the layout has fewer actuators than channels.
std::string soundFault(const LoadedClip& sound, const LoadedRender& job);

/// Starts the sound and sets the duration of `wanted` to its end. Empty, or one error line. Message thread.
std::string beginSound(LivePlay& wanted, const Session& session, MessageRouter& messages);

} // namespace physvib
