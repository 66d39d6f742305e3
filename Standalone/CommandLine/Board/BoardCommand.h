// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib board`: what a four-channel board is, how it does, and an event list on it.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include "Scene/FieldSize.h"
#include <string>

namespace physvib {

class OptionTable;

struct BoardOptions {
    std::string port;                   ///< a path, or "auto"
    std::string action;                 ///< info, play or test
    std::string eventsPath;             ///< for play
    std::string layout = "phone4";      ///< of at most four enchanters: the board's channels in their order
    FieldSize field;                    ///< of the list; not known: as it says, else the layout's extent
    double levelDb = safeStartDecibels; ///< master level of play
};

void declareBoardOptions(OptionTable& command, BoardOptions& options);

/// An exit code.
int runBoard(const BoardOptions& options);

struct LoadedRender;

/// A scene felt on the board alone (`physvib play --board`), its world stepped by this computer's clock; an
/// exit code.
int runSceneOnBoard(const std::string& port, const LoadedRender& job, double levelDb);

} // namespace physvib
