// SPDX-License-Identifier: GPL-3.0-or-later
// Of the devices that are there, the one that actuators are likely to hang on.
#pragma once
#include "Host/Devices/AudioDevices.h"

namespace physvib {

/// How many outputs lead somewhere of their own: what mixes for a sound server has two, whatever it says. Any
/// thread.
int ownOutputs(const AudioDeviceName& device);

/// The likely ones first: many outputs before few, a running JACK before its rivals, screens and no device at
/// last. Any thread.
std::vector<AudioDeviceName> byLikelihood(std::vector<AudioDeviceName> devices);

/// The preset for so many outputs, at most four. Any thread.
const char* layoutFor(int outputs);

} // namespace physvib
