// SPDX-License-Identifier: GPL-3.0-or-later
// Null audio device that asks for blocks by a steady clock and discards them. It lets a world run, be shown
// and be recorded on a machine without an audio interface.
#pragma once
#include <juce_audio_devices/juce_audio_devices.h>
#include <memory>
#include <vector>

namespace physvib {

/// The driver's name; its device is noDeviceName.
inline constexpr const char* noDeviceType = "None";
inline constexpr const char* noDeviceName = "no device";

/// A driver with that one device: 64 outputs, 48 kHz and blocks of 512 frames unless the settings say
/// otherwise. M.
class NoDeviceType final : public juce::AudioIODeviceType {
public:
    NoDeviceType()
        : juce::AudioIODeviceType{noDeviceType} {}
    void scanForDevices() override {}
    juce::StringArray getDeviceNames(bool inputs) const override {
        return inputs ? juce::StringArray{} : juce::StringArray{noDeviceName};
    }
    int getDefaultDeviceIndex(bool) const override { return 0; }
    int getIndexOfDevice(juce::AudioIODevice* device, bool) const override {
        return device != nullptr ? 0 : -1;
    }
    bool hasSeparateInputsAndOutputs() const override { return false; }
    juce::AudioIODevice* createDevice(const juce::String& output, const juce::String&) override;
};

/// The system's drivers and the null driver. M.
std::vector<std::unique_ptr<juce::AudioIODeviceType>> audioDeviceTypesAndNone();

} // namespace physvib
