// SPDX-License-Identifier: MIT
// Lists the audio output devices of drivers, and finds one of them by its name.
#pragma once
#include "Live/Devices/AudioDevice.h"

namespace physvib {

/// One output device of one driver.
struct AudioDeviceName {
    std::string type; ///< "ALSA", "JACK", "CoreAudio"...
    std::string name;
    int channels = 0; ///< number of outputs; 0 if the driver could not be queried
};

/// All output devices that can be opened, or that another program has. M; scans the drivers, which takes a
/// while.
std::vector<AudioDeviceName> listAudioDevices(const AudioDrivers& drivers);

/// A device that is not open yet, and its driver, which must outlive the device.
struct FoundDevice {
    std::unique_ptr<AudioDriver> driver;
    std::unique_ptr<AudioDevice> device;

    /// "driver:name": identifies this device and no other.
    std::string fullName() const { return driver->name() + ":" + device->name(); }
};

/// The device with that name or driver:name, or the first Pico for `pico`; empty if there is none.
/// `withInputs`: opens inputs of the same name too, if there are any. M; scans drivers only until it finds
/// the device.
FoundDevice findAudioDevice(const AudioDrivers& drivers, const std::string& name, bool withInputs = false);

/// The layout preset of the Pico with that name, or of the one that `pico` finds: "pico4", "pico8"; empty:
/// that is no Pico. M; scans drivers for `pico` alone.
std::string picoLayout(const AudioDrivers& drivers, const std::string& name);

} // namespace physvib
