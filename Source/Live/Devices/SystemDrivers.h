// SPDX-License-Identifier: MIT
// The audio drivers of this system.
#pragma once
#include "Live/Devices/AudioDevice.h"

namespace physvib {

/// In the order in which names are searched. M.
std::vector<std::unique_ptr<AudioDriver>> systemAudioDrivers();

} // namespace physvib
