// SPDX-License-Identifier: GPL-3.0-or-later
// Lists the audio output devices of the system, and finds one of them by its name.
#pragma once
#include <functional>
#include <juce_audio_devices/juce_audio_devices.h>
#include <memory>
#include <string>
#include <vector>

namespace physvib {

/// One output device of one driver.
struct AudioDeviceName {
    std::string type; ///< "ALSA", "JACK", "CoreAudio"...
    std::string name;
    int channels = 0; ///< number of outputs; 0 if the driver could not be queried
};

/// Creates the driver types to search; they have not been scanned yet. M.
using AudioDeviceTypes = std::function<std::vector<std::unique_ptr<juce::AudioIODeviceType>>()>;

/// The drivers of this system that JUCE supports, in the order in which names are searched.
std::vector<std::unique_ptr<juce::AudioIODeviceType>> systemAudioDeviceTypes();

/// All output devices. M; scans the drivers, which takes a while.
std::vector<AudioDeviceName> listAudioDevices(const AudioDeviceTypes& types = systemAudioDeviceTypes);

/// A device that is not open yet, and its driver, which must outlive the device.
struct FoundDevice {
    std::unique_ptr<juce::AudioIODeviceType> type;
    std::unique_ptr<juce::AudioIODevice> device;

    /// "type:name": identifies this device and no other.
    std::string fullName() const {
        return type->getTypeName().toStdString() + ":" + device->getName().toStdString();
    }
};

/// The device with that name or type:name; empty if there is none. `withInputs`: opens inputs of the same
/// name too, if there are any. M; scans drivers only until it finds the device.
FoundDevice findAudioDevice(const AudioDeviceTypes& types, const std::string& name, bool withInputs = false);

} // namespace physvib
