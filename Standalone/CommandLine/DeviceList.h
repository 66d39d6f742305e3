// SPDX-License-Identifier: GPL-3.0-or-later
// Audio devices of this machine, for the list of `devices` and the suggestion of `play`.
#pragma once
#include "Live/Devices/AudioDevice.h"
#include <ostream>
#include <string>
#include <vector>

namespace physvib {

/// Available devices in the system's order. Message thread; queries the system.
inline std::vector<AudioDeviceName> devicesOfThisMachine() { return listAudioDevices(systemAudioDrivers); }

/// One line per device: the name for --device, and its number of outputs.
inline void printDevices(std::ostream& out, const std::vector<AudioDeviceName>& devices) {
    for (const auto& device : devices)
        out << device.type << ':' << device.name << "  " << device.channels << " outputs\n";
}

/// A call of `play` with the first device that has four outputs, else with the device with most outputs, and
/// a layout that fits it.
inline std::string proposedCall(const std::string& scene, const std::vector<AudioDeviceName>& devices) {
    const AudioDeviceName* best = nullptr;
    for (const auto& device : devices)
        if (best == nullptr || (best->channels < 4 && device.channels > best->channels)) best = &device;
    const std::string call = "physvib play " + (scene.empty() ? "shake-the-box" : scene) + " --device ";
    if (best == nullptr || best->channels < 1) return call + "\"None:no device\"";
    const std::string name = '"' + best->type + ':' + best->name + '"';
    const int count = best->channels < 4 ? best->channels : 4;
    std::string map = "1";
    for (int output = 2; output <= count; ++output) map += ',' + std::to_string(output);
    return call + name + (count < 4 ? " --layout phone" + std::to_string(count) : std::string{}) + " --map " +
           map;
}

} // namespace physvib
