// SPDX-License-Identifier: MIT
// Guesses which audio device the actuators are connected to.
#pragma once
#include "Live/Devices/AudioDevices.h"
#include <string_view>

namespace physvib {

/// Number of outputs that reach the hardware one to one. A device that mixes for a sound server counts as
/// two at most, whatever it reports. Any thread.
int ownOutputs(const AudioDeviceName& device);

/// Sorted by likelihood: many outputs before few, a Pico and a running JACK server before other devices,
/// displays and "no device" last. Any thread.
std::vector<AudioDeviceName> byLikelihood(std::vector<AudioDeviceName> devices);

/// The layout preset for that many outputs, at most four; a Pico's own ones for its four or eight. Any
/// thread.
const char* layoutFor(int outputs, std::string_view device = {});

} // namespace physvib
