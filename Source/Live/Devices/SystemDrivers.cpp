// SPDX-License-Identifier: MIT
// The drivers whose libraries this machine has.
#include "Live/Devices/AlsaDevice.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/JackDevice.h"

namespace physvib {
namespace {

bool isJackThere() {
    const JackLibrary* const jack = jackLibrary();
    return jack != nullptr && JackClient{*jack, "physvib-scan"}.isAlive();
}

} // namespace

std::vector<std::unique_ptr<AudioDriver>> systemAudioDrivers() {
    std::vector<std::unique_ptr<AudioDriver>> drivers;
    if (const JackLibrary* jack = jackLibrary()) drivers.push_back(std::make_unique<JackDriver>(*jack));
    if (const AlsaLibrary* alsa = alsaLibrary())
        drivers.push_back(std::make_unique<AlsaDriver>(*alsa, isJackThere));
    return drivers;
}

} // namespace physvib
