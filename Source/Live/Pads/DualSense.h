// SPDX-License-Identifier: MIT
// Switches the coils of a DualSense controller from emulated motors to channels 3 and 4 of its audio device.
// Tested on a model of the device, not on hardware (Docs/pads.md).
#pragma once
#include "Io/Text/CleanText.h"
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace physvib::dualsense {

/// Output report 0x02 without its number, as SDL_GameControllerSendEffect expects it. According to SDL's
/// driver, the kernel's hid-playstation and public descriptions, byte 0 has bit 0 for emulated motors and bit
/// 1 for "no audio on the coils"; bytes 2 and 3 are the motor levels; the other bytes have no effect while
/// their flags are 0. So the whole report is 0.
using Report = std::array<std::uint8_t, 47>;
constexpr std::size_t flagsByte = 0, rightMotorByte = 2, leftMotorByte = 3;
constexpr std::uint8_t emulatesMotors = 0x01, keepsSoundFromCoils = 0x02;
constexpr Report coilsToSound() noexcept { return {}; }

constexpr int outputs = 4, leftCoil = 2, rightCoil = 3; ///< outputs of its audio device, from 0; the first
                                                        ///< two are loudspeaker and headphones

/// Whether an audio device with that name is a DualSense. Over USB the name is "DualSense Wireless
/// Controller" or "DualSense Edge ...".
inline bool isDevice(std::string_view name) {
    return lowerCase(std::string{name}).find("dualsense") != std::string::npos;
}

} // namespace physvib::dualsense
