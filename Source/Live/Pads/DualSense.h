// SPDX-License-Identifier: MIT
// What makes a DualSense's coils play its sound device's channels 3 and 4 instead of emulated motors. Tried
// on a model of the device, not on silicon (Docs/pads.md).
#pragma once
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>

namespace physvib::dualsense {

/// Output report 0x02 without its number, as SDL_GameControllerSendEffect takes it. SDL's driver, the
/// kernel's hid-playstation and public descriptions agree: byte 0 has bit 0 for emulated motors and bit 1 for
/// "no sound on the coils", bytes 2 and 3 are the motors' levels, and the other bytes change nothing while
/// their flags are 0. So all of it is 0.
using Report = std::array<std::uint8_t, 47>;
constexpr std::size_t flagsByte = 0, rightMotorByte = 2, leftMotorByte = 3;
constexpr std::uint8_t emulatesMotors = 0x01, keepsSoundFromCoils = 0x02;
constexpr Report coilsToSound() noexcept { return {}; }

constexpr int outputs = 4, leftCoil = 2, rightCoil = 3; ///< of its sound device, from 0; the first two are
                                                        ///< speaker and headphones

/// Whether a sound device of that name is one. Over USB it calls itself "DualSense Wireless Controller" or
/// "DualSense Edge ...".
inline bool isDevice(std::string_view name) {
    std::string lower{name};
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower.find("dualsense") != lower.npos;
}

} // namespace physvib::dualsense
