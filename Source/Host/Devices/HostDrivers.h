// SPDX-License-Identifier: GPL-3.0-or-later
// The audio drivers of a program with a window.
#pragma once
#include "Live/Devices/AudioDevice.h"

namespace physvib {

/// Our own on Linux (AudioDevice.h), those of JUCE elsewhere; in the order in which names are searched. M.
std::vector<std::unique_ptr<AudioDriver>> hostAudioDrivers();

} // namespace physvib
