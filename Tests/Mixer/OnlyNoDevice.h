// SPDX-License-Identifier: GPL-3.0-or-later
// A clock instead of a device.
#pragma once
#include "Live/Devices/AudioDevice.h"

namespace physvib::test {

inline AudioDrivers onlyNoDevice() {
    return withNullDevice([] { return std::vector<std::unique_ptr<AudioDriver>>{}; });
}

} // namespace physvib::test
