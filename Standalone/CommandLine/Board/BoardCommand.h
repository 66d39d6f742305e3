// SPDX-License-Identifier: GPL-3.0-or-later
// Options of `physvib board`: information on a four-channel board, a test, and playing an event list on it.
#pragma once
#include "Live/Devices/AudioOutput.h"
#include "Scene/FieldSize.h"
#include <string>

namespace physvib {

class OptionTable;

struct BoardOptions {
    std::string port;                   ///< path, or "auto"
    std::string action;                 ///< info, play or test
    std::string eventsPath;             ///< for play
    std::string layout = "phone4";      ///< at most four actuators, in the order of the board's channels
    FieldSize field;                    ///< of the list; unset: the list's own, else the layout's extent
    double levelDb = safeStartDecibels; ///< master level of play
};

void declareBoardOptions(OptionTable& command, BoardOptions& options);

/// Returns an exit code.
int runBoard(const BoardOptions& options);

} // namespace physvib
