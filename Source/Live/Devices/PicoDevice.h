// SPDX-License-Identifier: MIT
// The Raspberry Pi Pico (Docs/pico.md) among the audio devices: an ordinary sound card that is known by its
// product's name.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Finds the first Pico under any driver, as a device's name.
inline constexpr std::string_view picoDeviceName = "pico";

/// Part of its name as every operating system has it (Firmware/Pico/Usb.cpp); behind it 4 or 8.
inline constexpr std::string_view picoProduct = "PhysVib pico";

/// From a USB packet to the first of its frames at the pins (Tests/Firmware/pico.sh). No driver reports it.
inline constexpr double picoLatencySeconds = 0.0028;

inline bool isPico(std::string_view device) {
    return device == picoDeviceName || device.find(picoProduct) != std::string_view::npos;
}

/// The Pico among a driver's devices; empty: there is none. ALSA lists parts of a card, too: the card itself
/// is preferred, because it has all its channels in their order. Any thread.
inline std::string picoAmong(const std::vector<std::string>& devices) {
    std::string found;
    for (const std::string& device : devices) {
        if (!isPico(device)) continue;
        if (device.find("Direct hardware device") != std::string::npos) return device;
        if (found.empty()) found = device;
    }
    return found;
}

/// The layout preset for the Pico with that name: "pico4", "pico8"; empty: the name does not say. Any thread.
inline std::string picoLayoutOf(std::string_view device) {
    const auto at = device.find(picoProduct);
    if (at == std::string_view::npos) return {};
    const std::string preset{device.substr(at + picoProduct.size() - picoDeviceName.size(), 5)};
    return preset == "pico4" || preset == "pico8" ? preset : std::string{};
}

} // namespace physvib
