// SPDX-License-Identifier: MIT
// Device callback that forwards to its owner until it is detached. The owner can then be destroyed while a
// driver that hangs still calls.
#pragma once
#include "Live/Devices/AudioDevice.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace physvib {

/// Outputs silence once detached. It lives as long as the device, however late the driver releases it.
class DeviceCallback final : public DeviceUser {
public:
    explicit DeviceCallback(DeviceUser& owner) noexcept
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
    void block(const float* const* in, int inputs, float* const* out, int outputs,
               int frames) noexcept override {
        const bool isHeard = call([&](auto& owner) { owner.block(in, inputs, out, outputs, frames); });
        for (int k = 0; !isHeard && k < outputs; ++k) std::fill_n(out[k], frames, 0.0f);
    }
    void aboutToStart(AudioDevice& device) override {
        call([&](auto& owner) { owner.aboutToStart(device); });
    }
    void stopped() override {
        call([](auto& owner) { owner.stopped(); });
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

    std::atomic<DeviceUser*> owner_;
    std::atomic<int> calls_{0};
};

} // namespace physvib
