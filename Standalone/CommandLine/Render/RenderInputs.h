// SPDX-License-Identifier: GPL-3.0-or-later
// The one door by which scenes, saved sessions and event lists become the events of a render or an export.
#pragma once
#include "Calls/LoadedRender.h"

namespace physvib {

/// Reads and checks what the options name: scene, session, clip or event list, layout, actuators, coupling.
/// exitDone, or the code to leave with after a line on stderr. M only.
int takeInputs(LoadedRender& job);

/// The job's events, shaped as its options say: simulated, or those of the list. Warnings for people on what
/// the shaping loses; or one line. M only.
Result<std::vector<std::string>> makeEvents(LoadedRender& job);

} // namespace physvib
