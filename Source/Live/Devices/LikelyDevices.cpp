// SPDX-License-Identifier: MIT
// Scores devices by name and number of outputs, without opening any.
#include "Live/Devices/LikelyDevices.h"
#include "Live/Devices/NoDevice.h"
#include "Live/Devices/PicoDevice.h"
#include <algorithm>

namespace physvib {
namespace {

bool says(const AudioDeviceName& device, std::initializer_list<const char*> words) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; };
    const auto isSame = [lower](char a, char b) { return lower(a) == lower(b); };
    return std::ranges::any_of(words, [&](std::string_view word) {
        return std::search(device.name.begin(), device.name.end(), word.begin(), word.end(), isSame) !=
               device.name.end();
    });
}

int likelihood(const AudioDeviceName& device) {
    if (device.type == noDeviceType) return -100;
    const int outputs = ownOutputs(device);
    int points = outputs > 2 ? 50 : 10 * outputs;
    if (device.type == "JACK") points += 10;
    if (says(device, {"DualSense"})) points += 5;
    if (isPico(device.name)) points += 20; // it has no other use
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

const char* layoutFor(int outputs, std::string_view device) {
    if (isPico(device) && outputs >= 4) return outputs >= 8 ? "pico8" : "pico4";
    return outputs >= 4 ? "phone4" : outputs == 3 ? "phone3" : outputs == 2 ? "phone2" : "phone1";
}

} // namespace physvib
