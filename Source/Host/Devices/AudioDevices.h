// SPDX-License-Identifier: GPL-3.0-or-later
// Which audio devices there are, and one of them by its name.
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
    int channels = 0; ///< outputs it offers; 0 if it could not be asked
};

/// Makes the driver types to look in; they have not been scanned. M.
using AudioDeviceTypes = std::function<std::vector<std::unique_ptr<juce::AudioIODeviceType>>()>;

/// The drivers of this system that JUCE knows, in the order in which names are looked up.
std::vector<std::unique_ptr<juce::AudioIODeviceType>> systemAudioDeviceTypes();

/// All output devices. M; asks the system, which takes a while.
std::vector<AudioDeviceName> listAudioDevices(const AudioDeviceTypes& types = systemAudioDeviceTypes);

/// A device that is not open yet, and its driver, which must outlive it.
struct FoundDevice {
    std::unique_ptr<juce::AudioIODeviceType> type;
    std::unique_ptr<juce::AudioIODevice> device;

    /// "type:name": means this device and no other.
    std::string fullName() const {
        return type->getTypeName().toStdString() + ":" + device->getName().toStdString();
    }
};

/// The device of that name, or type:name; empty if there is none. `withInputs`: its inputs as well, if it has
/// any of the same name. M; scans no more drivers than it must.
FoundDevice findAudioDevice(const AudioDeviceTypes& types, const std::string& name, bool withInputs = false);

} // namespace physvib
