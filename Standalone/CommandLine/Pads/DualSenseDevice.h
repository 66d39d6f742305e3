// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the audio device of a DualSense controller, and switches its coils to audio.
#pragma once
#include "Host/Devices/AudioDevices.h"
#include "Io/Result.h"
#include <string>
#include <vector>

namespace physvib {

/// Name for --device that selects it with any driver.
inline constexpr const char* dualSenseDeviceName = "dualsense";

/// "type:name" of the first one with four outputs; or one line if there is none, or if its system profile
/// hides two outputs. Message thread.
Result<std::string> dualSenseDevice(const std::vector<AudioDeviceName>& devices);

/// Sends the report that switches the coils to audio; empty, or one error line. Coils are in audio mode from
/// connection until the first rumble command. Message thread; waits at most half a second for the controller.
std::string giveCoilsToSound();

} // namespace physvib
