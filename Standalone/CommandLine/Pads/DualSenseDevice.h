// SPDX-License-Identifier: GPL-3.0-or-later
// A DualSense's sound device among those of the system, and its coils given to it.
#pragma once
#include "Host/Devices/AudioDevices.h"
#include "Io/Result.h"
#include <string>
#include <vector>

namespace physvib {

/// What --device calls it: whichever driver has it.
inline constexpr const char* dualSenseDeviceName = "dualsense";

/// "type:name" of the first that has its four outputs; or one line: there is none, or its profile hides two
/// of them. M.
Result<std::string> dualSenseDevice(const std::vector<AudioDeviceName>& devices);

/// Sends the report that gives the coils to sound; empty, or in one line why not. They belong to sound from
/// the moment at which the controller is plugged in, until something rumbles. M; waits half a second for the
/// controller at most.
std::string giveCoilsToSound();

} // namespace physvib
