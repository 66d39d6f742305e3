// SPDX-License-Identifier: GPL-3.0-or-later
// A session live on a device until its time is over or the user interrupts, with all that goes along.
#pragma once
#include "Host/Music/BeatStrikes.h"
#include "Host/Osc/OscPort.h"
#include "Host/Rig/Rig.h"
#include "Live/Messages/ClipSource.h"
#include "Live/Session/Session.h"
#include <optional>
#include <string>

namespace physvib {

struct LivePlay {
    RigSettings rig;
    double seconds = 10.0;
    bool listens = false;              ///< to standard input, line by line (see readInputLine)
    std::optional<BeatVoices> beats{}; ///< what is heard at rig.output.inputs is struck so
    double beatSensitivity = 0.0;
    OscSettings osc;
    std::string clips = ".";           ///< folder from which messages may have clips read
    bool keepsPlaying = false;         ///< when standard input has ended
    std::optional<LoadedClip> sound{}; ///< played once, from the beginning
};

/// Empty, or one line with the reason. M.
std::string playLive(LivePlay wanted);

} // namespace physvib
