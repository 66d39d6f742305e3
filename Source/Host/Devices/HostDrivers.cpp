// SPDX-License-Identifier: GPL-3.0-or-later
// JUCE's device types and devices behind the interface of this project, where JUCE's module for them is
// linked.
#include "Host/Devices/HostDrivers.h"
#if !JUCE_MODULE_AVAILABLE_juce_audio_devices

namespace physvib {

std::vector<std::unique_ptr<AudioDriver>> hostAudioDrivers() { return systemAudioDrivers(); }

} // namespace physvib
#else
#include <juce_audio_devices/juce_audio_devices.h>
#include <utility>

namespace physvib {

namespace {

juce::BigInteger bitsOf(const ChannelSet& channels) {
    juce::BigInteger bits;
    for (const int k : channels) bits.setBit(k);
    return bits;
}

class JuceDevice final : public AudioDevice, private juce::AudioIODeviceCallback {
public:
    explicit JuceDevice(std::unique_ptr<juce::AudioIODevice> device)
        : device_{std::move(device)} {}

    std::string name() const override { return device_->getName().toStdString(); }
    int outputs() override { return device_->getOutputChannelNames().size(); }
    int inputs() override { return device_->getInputChannelNames().size(); }
    int defaultBlockFrames() override { return device_->getDefaultBufferSize(); }
    std::string open(const ChannelSet& inputs, const ChannelSet& outputs, int rate, int block) override {
        return device_
            ->open(bitsOf(inputs), bitsOf(outputs), rate > 0 ? rate : device_->getCurrentSampleRate(),
                   block > 0 ? block : defaultBlockFrames())
            .toStdString();
    }
    void close() override { device_->close(); }
    bool isOpen() override { return device_->isOpen(); }
    void start(AudioDeviceCallback& user) override {
        user_ = &user;
        device_->start(this);
    }
    void stop() override { device_->stop(); }
    int sampleRateHz() override { return juce::roundToInt(device_->getCurrentSampleRate()); }
    int blockFrames() override { return device_->getCurrentBufferSizeSamples(); }
    ChannelSet activeOutputs() const override {
        const juce::BigInteger bits = device_->getActiveOutputChannels();
        ChannelSet active;
        for (int k = bits.findNextSetBit(0); k >= 0; k = bits.findNextSetBit(k + 1)) active.insert(k);
        return active;
    }
    int deviceLatencyFrames() override { return device_->getOutputLatencyInSamples(); }
    int xruns() const override { return device_->getXRunCount(); }

private:
    void audioDeviceIOCallbackWithContext(const float* const* in, int inputs, float* const* out, int outputs,
                                          int frames, const juce::AudioIODeviceCallbackContext&) override {
        user_->processBlock(in, inputs, out, outputs, frames);
    }
    void audioDeviceAboutToStart(juce::AudioIODevice*) override { user_->aboutToStart(*this); }
    void audioDeviceStopped() override { user_->stopped(); }
    void audioDeviceError(const juce::String&) override { user_->stopped(); }

    std::unique_ptr<juce::AudioIODevice> device_;
    AudioDeviceCallback* user_ = nullptr; // changes only while the device does not run
};

class JuceDriver final : public AudioDriver {
public:
    explicit JuceDriver(juce::AudioIODeviceType* type)
        : type_{type} {}

    std::string name() const override { return type_->getTypeName().toStdString(); }
    void scan() override { type_->scanForDevices(); }
    std::vector<std::string> deviceNames(bool inputs) override {
        std::vector<std::string> names;
        for (const auto& name : type_->getDeviceNames(inputs)) names.push_back(name.toStdString());
        return names;
    }
    std::unique_ptr<AudioDevice> create(const std::string& name, bool withInputs) override {
        const auto output = juce::String::fromUTF8(name.c_str());
        std::unique_ptr<juce::AudioIODevice> device{
            type_->createDevice(output, withInputs ? output : juce::String{})};
        return device ? std::make_unique<JuceDevice>(std::move(device)) : nullptr;
    }

private:
    std::unique_ptr<juce::AudioIODeviceType> type_;
};

} // namespace

std::vector<std::unique_ptr<AudioDriver>> hostAudioDrivers() {
    using Type = juce::AudioIODeviceType;
    std::vector<std::unique_ptr<AudioDriver>> drivers;
    for (Type* type : {Type::createAudioIODeviceType_CoreAudio(),
                       Type::createAudioIODeviceType_WASAPI(juce::WASAPIDeviceMode::exclusive),
                       Type::createAudioIODeviceType_ASIO()})
        if (type != nullptr)
            drivers.push_back(std::make_unique<JuceDriver>(type)); // null: not on this system
    return drivers;
}

} // namespace physvib
#endif
