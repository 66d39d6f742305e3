// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a live session on a device until its duration is over or the user interrupts, with all its inputs and
// sinks.
#pragma once
#include "Calls/LoadedRender.h"
#include "Host/Music/BeatDetector.h"
#include "Host/Osc/OscPort.h"
#include "Live/Messages/MessageRouter.h"
#include "Live/Rig/Rig.h"
#include <optional>
#include <string>
#include <string_view>

namespace physvib {
struct LivePlay {
    RigSettings rig;
    double seconds = 10.0;
    bool listens = false;              ///< reads standard input, line by line (see readInputLine)
    std::optional<BeatVoices> beats{}; ///< plays beats of the input at rig.output.inputs
    double beatSensitivity = 0.0;
    OscSettings osc;
    std::string clips = ".";           ///< folder of clips that messages may name
    bool keepsPlaying = false;         ///< continue after the end of standard input
    std::optional<LoadedClip> sound{}; ///< a clip that is played once at the start
};

/// Empty, or one error line. Message thread.
std::string playLive(LivePlay wanted);

// Plays a sound file on the actuators, as a clip in a session without bodies, with its safety limits.

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
