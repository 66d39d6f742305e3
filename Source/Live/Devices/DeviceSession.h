// SPDX-License-Identifier: MIT
// Finds, opens, calls and closes one audio device. A driver may hang in these calls, so they run on a thread
// of their own and the caller waits for a limited time only.
#pragma once
#include "Live/Devices/AudioDevice.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>

namespace physvib {

// Device callback that forwards to its owner until it is detached. The owner can then be destroyed while a
// driver that hangs still calls.

/// Outputs silence once detached. It lives as long as the device, however late the driver releases it.
class DeviceCallback final : public DeviceUser {
public:
    explicit DeviceCallback(DeviceUser& owner) noexcept
        : owner_{owner} {}

    /// Detaches the owner and returns when the render thread has left it. M, not from within a driver's call.
    void letGo() noexcept { owner_.end(); }
    /// See UserSlot.
    void awaitBlock() const noexcept { owner_.awaitBlock(); }

private:
    void block(const float* const* in, int inputs, float* const* out, int outputs,
               int frames) noexcept override {
        owner_.call([&](DeviceUser* owner) {
            if (owner != nullptr) return owner->block(in, inputs, out, outputs, frames);
            for (int k = 0; k < outputs; ++k) std::fill_n(out[k], frames, 0.0f);
        });
    }
    void aboutToStart(AudioDevice& device) override {
        owner_.call([&](DeviceUser* owner) {
            if (owner != nullptr) owner->aboutToStart(device);
        });
    }
    void stopped() override {
        owner_.call([](DeviceUser* owner) {
            if (owner != nullptr) owner->stopped();
        });
    }

    UserSlot owner_;
};

/// Which device to open, and how.
struct DeviceRequest {
    std::string name;           ///< name or driver:name
    ChannelSet inputs, outputs; ///< outputs that the device lacks are left out, as long as one remains
    int highestHeard = -1;      ///< index of an output that the device must have
    int sampleRateHz = 0, blockFrames = 0; ///< 0: device default
    bool opensAll = false;                 ///< opens all outputs

    bool operator==(const DeviceRequest&) const = default;

    /// Empty, or what the device lacks. M, or the thread that opens the device.
    std::string fault(AudioDevice& device) const;
};

/// All methods: M.
class DeviceSession {
public:
    using Limit = std::chrono::milliseconds;

    /// `hurry` (may be null; outlives the keeper) ends every wait but that of close() when it becomes true.
    DeviceSession(AudioDrivers drivers, const std::atomic<bool>* hurry);
    ~DeviceSession();

    /// Finds and opens a device; none may be open. Returns empty, or one line with the reason. If the driver
    /// has not answered in time, a later call with the same wish gets the device.
    std::string open(const DeviceRequest& wish, Limit limit);

    /// Whether the last open() failed because the device is not there, or has no outputs.
    bool isMissing() const noexcept { return isMissing_; }

    /// From now on the device calls `owner`; its first call (about to start) comes before this returns.
    void start(DeviceUser& owner);
    void restart(); ///< with the device's current settings
    /// Stops calling the owner and returns when the render thread has left it; the device then plays silence.
    void letGo() noexcept;
    /// Returns when the render thread has left the block it was in.
    void awaitBlock() const noexcept;

    /// A device that is not closed within `limit` is abandoned to its thread.
    void close(Limit limit = closing);
    static constexpr Limit closing{250};

    AudioDevice* device() const noexcept { return found_.device.get(); } ///< null: none is open
    std::string fullName() const { return found_.fullName(); }

private:
    struct Opening;
    using Clock = DeviceThread::Clock;
    bool isIdle(Clock::time_point end, const std::atomic<bool>* hurry);
    void drop(FoundDevice& found);

    AudioDrivers drivers_;
    const std::atomic<bool>* const hurry_;
    FoundDevice found_;
    std::shared_ptr<DeviceCallback> callback_;
    std::shared_ptr<Opening> opening_;    // until its result is used
    std::shared_ptr<FoundDevice> closed_; // until the device is destroyed
    std::string at_;                      // device that the thread works on
    bool isMissing_ = false;
    bool isLate_ = false; // a call has exceeded its time limit
    DeviceThread thread_;
};

} // namespace physvib
