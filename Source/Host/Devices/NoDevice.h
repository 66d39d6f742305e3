// SPDX-License-Identifier: GPL-3.0-or-later
// An audio device that is not there: blocks in time with a steady clock, felt by nobody. With it a world
// runs, is seen, and can be recorded on a machine without an interface.
#pragma once
#include <juce_audio_devices/juce_audio_devices.h>
#include <memory>
#include <vector>

namespace physvib {

/// The driver's name; its device is noDeviceName.
inline constexpr const char* noDeviceType = "None";
inline constexpr const char* noDeviceName = "no device";

/// A driver with that one device: 64 outputs, 48 kHz, blocks of 512 frames unless others are asked for. M.
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

/// The system's drivers, and that one. M.
std::vector<std::unique_ptr<juce::AudioIODeviceType>> audioDeviceTypesAndNone();

} // namespace physvib
