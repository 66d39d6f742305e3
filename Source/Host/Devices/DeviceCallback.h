// SPDX-License-Identifier: GPL-3.0-or-later
// Device callback that forwards to its owner until it is detached. The owner can then be destroyed while a
// driver that hangs still calls.
#pragma once
#include <atomic>
#include <juce_audio_devices/juce_audio_devices.h>
#include <thread>

namespace physvib {

/// Outputs silence once detached. It lives as long as the device, however late the driver releases it.
class DeviceCallback final : public juce::AudioIODeviceCallback {
public:
    explicit DeviceCallback(juce::AudioIODeviceCallback& owner) noexcept
        : owner_{&owner} {}

    /// Detaches the owner and returns when the render thread has left it. M, not from within a driver's call.
    void letGo() noexcept {
        owner_ = nullptr;
        awaitBlock();
    }

    /// Returns when the render thread has left the block it was in, if any. M.
    void awaitBlock() const noexcept {
        while (calls_ > 0) std::this_thread::sleep_for(std::chrono::milliseconds{1}); // at most for one block
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
        ++calls_; // sequentially consistent, as owner_: either this call sees the detachment, or letGo() sees
                  // this call
        auto* const owner = owner_.load();
        if (owner != nullptr) words(*owner);
        --calls_;
        return owner != nullptr;
    }

    std::atomic<juce::AudioIODeviceCallback*> owner_;
    std::atomic<int> calls_{0};
};

} // namespace physvib
