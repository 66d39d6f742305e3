// SPDX-License-Identifier: MIT
// Null audio device that asks for blocks by a steady clock and discards them. It lets a world run, be shown
// and be recorded on a machine without an audio interface.
#pragma once
#include "Live/Devices/AudioDevice.h"

namespace physvib {

/// The driver's name; its device is noDeviceName.
inline constexpr const char* noDeviceType = "None";
inline constexpr const char* noDeviceName = "no device";

/// A driver with that one device: 64 outputs, 48 kHz and blocks of 512 frames unless set otherwise. M.
std::unique_ptr<AudioDriver> makeNoDeviceDriver();

/// These drivers and the null driver. M.
AudioDrivers withNoDevice(AudioDrivers drivers);

} // namespace physvib
