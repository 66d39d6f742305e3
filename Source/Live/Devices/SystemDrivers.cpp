// SPDX-License-Identifier: MIT
// The audio drivers that this build supports and whose libraries this machine has.
#include "Live/Devices/AudioDevice.h"
#if defined(PHYSVIB_HAS_ALSA)
#include "Live/Devices/AlsaDevice.h"
#endif
#if defined(PHYSVIB_HAS_JACK)
#include "Live/Devices/JackDevice.h"
#endif

namespace physvib {
namespace {

[[maybe_unused]] bool isJackRunning() {
#if defined(PHYSVIB_HAS_JACK)
    const JackLibrary* const jack = jackLibrary();
    return jack != nullptr && JackClient{*jack, "physvib-scan"}.isAlive();
#else
    return false;
#endif
}

} // namespace

std::vector<std::unique_ptr<AudioDriver>> systemAudioDrivers() {
    std::vector<std::unique_ptr<AudioDriver>> drivers;
#if defined(PHYSVIB_HAS_JACK)
    if (const JackLibrary* jack = jackLibrary()) drivers.push_back(std::make_unique<JackDriver>(*jack));
#endif
#if defined(PHYSVIB_HAS_ALSA)
    if (const AlsaLibrary* alsa = alsaLibrary())
        drivers.push_back(std::make_unique<AlsaDriver>(*alsa, isJackRunning));
#endif
    return drivers;
}

} // namespace physvib
