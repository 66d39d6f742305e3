// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a live session on a device until its duration is over or the user interrupts, with all its inputs and
// sinks.
#pragma once
#include "Host/Music/BeatStrikes.h"
#include "Host/Osc/OscPort.h"
#include "Live/Messages/ClipSource.h"
#include "Live/Rig/Rig.h"
#include <optional>
#include <string>

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

} // namespace physvib
