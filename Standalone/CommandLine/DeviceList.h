// SPDX-License-Identifier: GPL-3.0-or-later
// The audio devices of this machine, as `devices` lists them and `play` proposes them.
#pragma once
#include "Host/Devices/AudioOutput.h"
#include <juce_events/juce_events.h>
#include <ostream>
#include <string>
#include <vector>

namespace physvib {

/// What is there now, in the systems' order. M; asks the system.
inline std::vector<AudioDeviceName> devicesOfThisMachine() {
    const juce::ScopedJuceInitialiser_GUI juce;
    return listAudioDevices();
}

/// A line each: the name that --device takes, and its outputs.
inline void printDevices(std::ostream& out, const std::vector<AudioDeviceName>& devices) {
    for (const auto& device : devices)
        out << device.type << ':' << device.name << "  " << device.channels << " outputs\n";
}

/// A call of `play` that can be typed: the first device with four outputs, else the one with most of them,
/// with a layout that it has room for.
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
