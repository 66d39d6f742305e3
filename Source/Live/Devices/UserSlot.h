// SPDX-License-Identifier: MIT
// Hands blocks of a device to whoever has started it, and ends that without a lock in the render thread.
#pragma once
#include "Live/Devices/AudioDevice.h"
#include <atomic>
#include <chrono>
#include <thread>

namespace physvib {

class UserSlot {
public:
    /// Blocks go to `user` from now on. M.
    void begin(AudioDevice& device, DeviceUser& user) {
        user.aboutToStart(device);
        user_ = &user;
    }

    /// Returns the user, if any, when the render thread has left its last block. M.
    DeviceUser* end() noexcept {
        DeviceUser* const user = user_.exchange(nullptr);
        while (calls_ > 0) std::this_thread::sleep_for(std::chrono::milliseconds{1}); // at most for one block
        return user;
    }

    /// Calls `words` with the user, or with null if nobody has started the device; end() returns after it.
    /// R, wait-free if `words` is.
    template <class Words>
    void call(const Words& words) noexcept {
        ++calls_; // sequentially consistent, as user_: either this call sees the end, or end() sees this call
        words(user_.load());
        --calls_;
    }

private:
    std::atomic<DeviceUser*> user_{nullptr};
    std::atomic<int> calls_{0};
};

} // namespace physvib
