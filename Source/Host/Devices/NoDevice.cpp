// SPDX-License-Identifier: GPL-3.0-or-later
// The null device's thread, with one absolute deadline per block.
#include "Host/Devices/NoDevice.h"
#include "Core/Limits.h"
#include "Host/Devices/AudioDevices.h"
#include <chrono>
#include <thread>
#include <vector>

namespace physvib {

namespace {

class NoDevice final : public juce::AudioIODevice, private juce::Thread {
public:
    NoDevice()
        : juce::AudioIODevice{noDeviceName, noDeviceType}
        , juce::Thread{"PhysVib without a device"} {}
    ~NoDevice() override { close(); }

    juce::StringArray getOutputChannelNames() override {
        juce::StringArray names;
        for (int k = 1; k <= limits::maxEnchanters; ++k) names.add("out " + juce::String{k});
        return names;
    }
    juce::StringArray getInputChannelNames() override { return {}; }
    juce::Array<double> getAvailableSampleRates() override { return {8000.0, 44100.0, 48000.0, 96000.0}; }
    juce::Array<int> getAvailableBufferSizes() override { return {64, 128, 256, 512, 1024, 2048}; }
    int getDefaultBufferSize() override { return 512; }
    juce::String open(const juce::BigInteger&, const juce::BigInteger& outputs, double rate,
                      int block) override {
        close();
        active_ = outputs;
        rate_ = rate > 0 ? rate : 48000.0;
        block_ = juce::jlimit(16, limits::maxBlockFrames, block > 0 ? block : getDefaultBufferSize());
        isOpen_ = true;
        return {};
    }
    void close() override {
        stop();
        isOpen_ = false;
    }
    bool isOpen() override { return isOpen_; }
    void start(juce::AudioIODeviceCallback* callback) override {
        stop();
        callback_ = callback;
        callback_->audioDeviceAboutToStart(this);
        startThread(Priority::high);
    }
    void stop() override {
        stopThread(-1);
        if (auto* old = std::exchange(callback_, nullptr)) old->audioDeviceStopped();
    }
    bool isPlaying() override { return callback_ != nullptr; }
    juce::String getLastError() override { return {}; }
    int getCurrentBufferSizeSamples() override { return block_; }
    double getCurrentSampleRate() override { return rate_; }
    int getCurrentBitDepth() override { return 32; }
    juce::BigInteger getActiveOutputChannels() const override { return active_; }
    juce::BigInteger getActiveInputChannels() const override { return {}; }
    int getOutputLatencyInSamples() override { return 0; }
    int getInputLatencyInSamples() override { return 0; }

private:
    void run() override {
        using Clock = std::chrono::steady_clock;
        std::vector<std::vector<float>> out(static_cast<std::size_t>(active_.countNumberOfSetBits()),
                                            std::vector<float>(static_cast<std::size_t>(block_)));
        std::vector<float*> at;
        for (auto& channel : out) at.push_back(channel.data());
        const auto length = std::chrono::nanoseconds{static_cast<std::int64_t>(1e9 * block_ / rate_)};
        for (auto deadline = Clock::now(); !threadShouldExit(); deadline += length) {
            // after a stall, the missed blocks are skipped instead of played in a burst
            if (const auto now = Clock::now(); now > deadline + 10 * length) deadline = now;
            std::this_thread::sleep_until(deadline);
            callback_->audioDeviceIOCallbackWithContext(nullptr, 0, at.data(), static_cast<int>(at.size()),
                                                        block_, {});
        }
    }

    juce::AudioIODeviceCallback* callback_ = nullptr; // changes only while the thread does not run
    juce::BigInteger active_;
    double rate_ = 48000.0;
    int block_ = 512;
    bool isOpen_ = false;
};

} // namespace

juce::AudioIODevice* NoDeviceType::createDevice(const juce::String& output, const juce::String&) {
    return output == noDeviceName ? new NoDevice : nullptr;
}

std::vector<std::unique_ptr<juce::AudioIODeviceType>> audioDeviceTypesAndNone() {
    auto types = systemAudioDeviceTypes();
    types.push_back(std::make_unique<NoDeviceType>());
    return types;
}

} // namespace physvib
