// SPDX-License-Identifier: GPL-3.0-or-later
// A clock instead of a device.
#pragma once
#include "Host/Devices/AudioDevices.h"
#include "Host/Devices/NoDevice.h"
#include <memory>
#include <vector>

namespace physvib::test {

inline AudioDeviceTypes onlyNoDevice() {
    return [] {
        std::vector<std::unique_ptr<juce::AudioIODeviceType>> types;
        types.push_back(std::make_unique<NoDeviceType>());
        return types;
    };
}

} // namespace physvib::test
