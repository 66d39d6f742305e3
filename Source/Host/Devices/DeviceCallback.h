// SPDX-License-Identifier: GPL-3.0-or-later
// What a driver calls in somebody's place: that one can go while the driver still calls, and hears no more of
// it.
#pragma once
#include <atomic>
#include <juce_audio_devices/juce_audio_devices.h>
#include <thread>

namespace physvib {

/// Silence once it was let go. It lives as long as the device, however late a driver lets that go.
class DeviceCallback final : public juce::AudioIODeviceCallback {
public:
    explicit DeviceCallback(juce::AudioIODeviceCallback& owner) noexcept
        : owner_{&owner} {}

    /// From now on the owner is called no more, and R has left it. M, in no call of the driver's.
    void letGo() noexcept {
        owner_ = nullptr;
        awaitBlock();
    }

    /// R has left the block that it was in, if it was in one. M.
    void awaitBlock() const noexcept {
        while (calls_ > 0) std::this_thread::sleep_for(std::chrono::milliseconds{1}); // a block at most
    }

private:
    void audioDeviceIOCallbackWithContext(const float* const* in, int inputs, float* const* out, int outputs,
                                          int frames,
                                          const juce::AudioIODeviceCallbackContext& context) override {
        const bool isHeard = call([&](auto& owner) {
            owner.audioDeviceIOCallbackWithContext(in, inputs, out, outputs, frames, context);
        });
        for (int k = 0; !isHeard && k < outputs; ++k) juce::FloatVectorOperations::clear(out[k], frames);
    }
    void audioDeviceAboutToStart(juce::AudioIODevice* device) override {
        call([&](auto& owner) { owner.audioDeviceAboutToStart(device); });
    }
    void audioDeviceStopped() override {
        call([](auto& owner) { owner.audioDeviceStopped(); });
    }
    void audioDeviceError(const juce::String& error) override {
        call([&](auto& owner) { owner.audioDeviceError(error); });
    }

    template <class Words>
    bool call(const Words& words) {
        ++calls_; // sequentially consistent, as owner_: either this sees that it was let go, or letGo() sees
                  // this
        auto* const owner = owner_.load();
        if (owner != nullptr) words(*owner);
        --calls_;
        return owner != nullptr;
    }

    std::atomic<juce::AudioIODeviceCallback*> owner_;
    std::atomic<int> calls_{0};
};

} // namespace physvib
