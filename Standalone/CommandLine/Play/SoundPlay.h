// SPDX-License-Identifier: GPL-3.0-or-later
// A sound on the actuators: one clip in a session where nothing moves, which guards it as all that is felt.
#pragma once
#include "Calls/LoadedRender.h"
#include "CommandLine/Play/LivePlay.h"
#include "Live/Messages/MessageRouter.h"
#include <string>
#include <string_view>

namespace physvib {

/// Whether it is called as a recording or a haptic file is.
bool namesSound(std::string_view file);

/// Reads the file that the job's options name as scene: a scene without bodies in `job`; in `options` the
/// file's length, and a layout of an actuator per channel, unless they were given. Or one line. M.
Result<LoadedClip> takeSound(RenderJob& options, LoadedRender& job);

/// Empty, or that the layout has no actuator for each channel.
std::string soundFault(const LoadedClip& sound, const LoadedRender& job);

/// Begins it now, and has `wanted` last until its last sample has left. Empty, or one line. M.
std::string beginSound(LivePlay& wanted, const Session& session, MessageRouter& messages);

} // namespace physvib
