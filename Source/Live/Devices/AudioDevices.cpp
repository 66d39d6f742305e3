// SPDX-License-Identifier: MIT
// Scans drivers for their output devices.
#include "Live/Devices/AudioDevices.h"
#include "Io/Text/CleanText.h"
#include "Live/Devices/PicoDevice.h"
#include <algorithm>

namespace physvib {

std::vector<AudioDeviceName> listAudioDevices(const AudioDrivers& drivers) {
    std::vector<AudioDeviceName> devices;
    for (const auto& driver : drivers()) {
        driver->scan();
        for (const std::string& name : driver->deviceNames(false))
            if (const auto device = driver->create(name, false))
                devices.push_back({driver->name(), name, device->outputs()});
    }
    return devices;
}

FoundDevice findAudioDevice(const AudioDrivers& drivers, const std::string& asked, bool withInputs) {
    auto all = drivers();
    // what older versions saved: a way to these very outputs that is not taken any more (AlsaDriver)
    const std::string wanted = asked == "ALSA:JACK Audio Connection Kit" ? "JACK:system" : asked;
    const auto prefix = [](const auto& driver) { return driver->name() + ":"; };
    const auto isNamed = [&](const auto& driver) { return wanted.starts_with(prefix(driver)); };
    const bool hasDriver = std::ranges::any_of(all, isNamed);
    for (auto& driver : all) {
        if (hasDriver && !isNamed(driver)) continue;
        driver->scan();
        std::string name = cleanLine(wanted.substr(hasDriver ? prefix(driver).size() : 0));
        const auto has = [&](bool inputs) {
            const auto names = driver->deviceNames(inputs);
            return std::ranges::find(names, name) != names.end();
        };
        if (name == picoDeviceName && !has(false)) name = picoAmong(driver->deviceNames(false));
        if (name.empty()) continue;
        auto device = driver->create(name, withInputs && has(true));
        if (device) return {std::move(driver), std::move(device)};
    }
    return {};
}

std::string picoLayout(const AudioDrivers& drivers, const std::string& name) {
    if (name != picoDeviceName) return picoLayoutOf(name);
    const auto found = findAudioDevice(drivers, name);
    return found.device ? picoLayoutOf(found.device->name()) : std::string{};
}

} // namespace physvib
