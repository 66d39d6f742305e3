// SPDX-License-Identifier: GPL-3.0-or-later
// Scores devices by name and number of outputs, without opening any.
#include "Host/Devices/LikelyDevices.h"
#include "Host/Devices/NoDevice.h"
#include <algorithm>

namespace physvib {
namespace {

bool says(const AudioDeviceName& device, std::initializer_list<const char*> words) {
    const auto name = juce::String::fromUTF8(device.name.c_str());
    return std::ranges::any_of(words, [&](const char* word) { return name.containsIgnoreCase(word); });
}

int likelihood(const AudioDeviceName& device) {
    if (device.type == noDeviceType) return -100;
    const int outputs = ownOutputs(device);
    int points = outputs > 2 ? 50 : 10 * outputs;
    if (device.type == "JACK") points += 10;
    if (says(device, {"DualSense"})) points += 5;
    if (says(device, {"HDMI", "DisplayPort", "Monitor of"})) points -= 40;
    return points;
}

} // namespace

int ownOutputs(const AudioDeviceName& device) {
    const bool isMixed =
        device.type == "ALSA" && says(device, {"default", "pulse", "pipewire", "dmix", "front:", "surround"});
    return isMixed ? std::min(2, device.channels) : device.channels;
}

std::vector<AudioDeviceName> byLikelihood(std::vector<AudioDeviceName> devices) {
    std::ranges::stable_sort(devices, std::greater{}, likelihood);
    return devices;
}

const char* layoutFor(int outputs) {
    return outputs >= 4 ? "phone4" : outputs == 3 ? "phone3" : outputs == 2 ? "phone2" : "phone1";
}

} // namespace physvib
