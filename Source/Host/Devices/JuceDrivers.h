// SPDX-License-Identifier: GPL-3.0-or-later
// The audio drivers of JUCE.
#pragma once
#include "Live/Devices/AudioDevice.h"

namespace physvib {

/// The drivers of this system that JUCE supports, in the order in which names are searched. M.
std::vector<std::unique_ptr<AudioDriver>> juceAudioDrivers();

} // namespace physvib
