// SPDX-License-Identifier: GPL-3.0-or-later
// Audio interfaces without hardware: they can be plugged in and out, come back with another rate, block and
// number of outputs, fail, fall silent, hang, and ask for blocks that they never announced.
#pragma once
#include "Host/Devices/AudioDevices.h"
#include <algorithm>
#include <atomic>
#include <mutex>

namespace physvib::test {

class FakeDevice;

/// The thing on the table. M changes it while nobody plays on it; play() is its own thread's business.
struct FakeInterface {
    juce::String name = "hands";
    bool isPlugged = true, opens = true;
    double rate = 48000;
    int block = 64, outputs = 8;
    std::vector<int> unconnected; ///< outputs that the callback does not get
    int withheld = 0;             ///< outputs that the callback does not get although they are active
    int timesOpened = 0, timesStarted = 0;
    juce::BigInteger opened;
    FakeDevice* device = nullptr;
    std::mutex mutex; // as JUCE's drivers: held during a callback and while the callback changes

    /// That call, and each after it, comes back after goOn() only, as of a driver whose server is stopped.
    enum class Call { none, open, close };
    std::atomic<Call> hangsIn{Call::none};
    void goOn() {
        hangsIn = Call::none;
        hangsIn.notify_all();
    }
    void hang(Call call) { hangsIn.wait(call); }

    /// One block of what comes out, a vector per connected output; those nobody writes keep `untouched`.
    static constexpr float untouched = 7.0f;
    std::vector<std::vector<float>> play(int frames);
    void unplug(bool tells);
};

class FakeDevice final : public juce::AudioIODevice {
public:
    explicit FakeDevice(FakeInterface& thing)
        : juce::AudioIODevice{thing.name, "Fake"}
        , thing_{thing} {}
    ~FakeDevice() override { close(); }

    juce::StringArray getOutputChannelNames() override {
        juce::StringArray names;
        for (int k = 0; k < thing_.outputs; ++k) names.add("out " + juce::String{k + 1});
        return names;
    }
    juce::StringArray getInputChannelNames() override { return {}; }
    juce::Array<double> getAvailableSampleRates() override { return {thing_.rate}; }
    juce::Array<int> getAvailableBufferSizes() override { return {thing_.block}; }
    int getDefaultBufferSize() override { return thing_.block; }
    juce::String open(const juce::BigInteger&, const juce::BigInteger& outputs, double, int) override {
        thing_.hang(FakeInterface::Call::open);
        ++thing_.timesOpened;
        if (!thing_.opens) return "busy";
        const std::lock_guard lock{thing_.mutex};
        thing_.opened = outputs;
        thing_.device = this;
        return {};
    }
    void close() override {
        thing_.hang(FakeInterface::Call::close);
        stop();
        const std::lock_guard lock{thing_.mutex};
        if (thing_.device == this) thing_.device = nullptr;
    }
    bool isOpen() override { return thing_.device == this; }
    void start(juce::AudioIODeviceCallback* callback) override {
        ++thing_.timesStarted;
        callback->audioDeviceAboutToStart(this);
        const std::lock_guard lock{thing_.mutex};
        callback_ = callback;
    }
    void stop() override {
        auto* old = take();
        if (old != nullptr) old->audioDeviceStopped();
    }
    bool isPlaying() override { return callback_ != nullptr; }
    juce::String getLastError() override { return {}; }
    int getCurrentBufferSizeSamples() override { return thing_.block; }
    double getCurrentSampleRate() override { return thing_.rate; }
    int getCurrentBitDepth() override { return 32; }
    juce::BigInteger getActiveOutputChannels() const override {
        auto active = thing_.opened;
        for (const int k : thing_.unconnected) active.clearBit(k);
        return active;
    }
    juce::BigInteger getActiveInputChannels() const override { return {}; }
    int getOutputLatencyInSamples() override { return thing_.block; }
    int getInputLatencyInSamples() override { return 0; }
    juce::AudioIODeviceCallback* callback() const { return callback_; }

private:
    juce::AudioIODeviceCallback* take() {
        const std::lock_guard lock{thing_.mutex};
        return std::exchange(callback_, nullptr);
    }
    FakeInterface& thing_;
    juce::AudioIODeviceCallback* callback_ = nullptr;
};

inline std::vector<std::vector<float>> FakeInterface::play(int frames) {
    const std::lock_guard lock{mutex};
    if (device == nullptr || device->callback() == nullptr) return {};
    const auto count =
        static_cast<std::size_t>(device->getActiveOutputChannels().countNumberOfSetBits() - withheld);
    std::vector<std::vector<float>> out(count,
                                        std::vector<float>(static_cast<std::size_t>(frames), untouched));
    std::vector<float*> at;
    for (auto& channel : out) at.push_back(channel.data());
    device->callback()->audioDeviceIOCallbackWithContext(nullptr, 0, at.data(), static_cast<int>(count),
                                                         frames, {});
    return out;
}

/// Gone from the list; a driver that `tells` says so as well, others just call no more.
inline void FakeInterface::unplug(bool tells) {
    isPlugged = false;
    if (tells && device != nullptr && device->callback() != nullptr)
        device->callback()->audioDeviceError("gone");
}

class FakeDeviceType final : public juce::AudioIODeviceType {
public:
    explicit FakeDeviceType(std::vector<FakeInterface*> things, const juce::String& name)
        : juce::AudioIODeviceType{name}
        , things_{std::move(things)} {}
    void scanForDevices() override {
        names_.clear();
        for (const auto* thing : things_)
            if (thing->isPlugged) names_.add(thing->name);
    }
    juce::StringArray getDeviceNames(bool inputs) const override {
        return inputs ? juce::StringArray{} : names_;
    }
    int getDefaultDeviceIndex(bool) const override { return 0; }
    int getIndexOfDevice(juce::AudioIODevice* device, bool) const override {
        return names_.indexOf(device->getName());
    }
    bool hasSeparateInputsAndOutputs() const override { return true; }
    juce::AudioIODevice* createDevice(const juce::String& name, const juce::String&) override {
        const auto thing = std::find_if(things_.begin(), things_.end(),
                                        [&](const auto* t) { return t->isPlugged && t->name == name; });
        return thing == things_.end() ? nullptr : new FakeDevice{**thing};
    }

private:
    std::vector<FakeInterface*> things_;
    juce::StringArray names_;
};

/// A system with these interfaces on one driver.
inline AudioDeviceTypes fakeTypes(std::vector<FakeInterface*> things, const juce::String& driver = "Fake") {
    return [=] {
        std::vector<std::unique_ptr<juce::AudioIODeviceType>> types;
        types.push_back(std::make_unique<FakeDeviceType>(things, driver));
        return types;
    };
}

} // namespace physvib::test
