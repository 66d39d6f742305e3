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
class DetachableCallback final : public AudioDeviceCallback {
public:
    explicit DetachableCallback(AudioDeviceCallback& owner) noexcept
        : owner_{owner} {}

    /// Detaches the owner and returns when the render thread has left it. M, not from within a driver's call.
    void detach() noexcept { owner_.end(); }
    /// See CallbackSlot::awaitBlock().
    void awaitBlock() const noexcept { owner_.awaitBlock(); }

private:
    void processBlock(const float* const* in, int inputs, float* const* out, int outputs,
                      int frames) noexcept override {
        owner_.call([&](AudioDeviceCallback* owner) {
            if (owner != nullptr) return owner->processBlock(in, inputs, out, outputs, frames);
            for (int k = 0; k < outputs; ++k) std::fill_n(out[k], frames, 0.0f);
        });
    }
    void aboutToStart(AudioDevice& device) override {
        owner_.call([&](AudioDeviceCallback* owner) {
            if (owner != nullptr) owner->aboutToStart(device);
        });
    }
    void stopped() override {
        owner_.call([](AudioDeviceCallback* owner) {
            if (owner != nullptr) owner->stopped();
        });
    }

    CallbackSlot owner_;
};

/// The device to open, its channels and settings.
struct DeviceRequest {
    std::string name;                ///< name or driver:name
    ChannelSet inputs, outputs;      ///< outputs that the device lacks are left out, as long as one remains
    int highestListeningOutput = -1; ///< index of an output that the device must have
    int sampleRateHz = 0, blockFrames = 0; ///< 0: device default
    bool opensAll = false;                 ///< opens all outputs

    bool operator==(const DeviceRequest&) const = default;

    /// Empty, or what the device lacks. M, or the thread that opens the device.
    std::string errorFor(AudioDevice& device) const;
};

/// One device from search to close, over DeviceThread. All methods: M.
class DeviceSession {
public:
    using TimeLimit = std::chrono::milliseconds;

    /// `cancel` (may be null; outlives this object) ends every wait but that of close() when it becomes true.
    DeviceSession(AudioDrivers drivers, const std::atomic<bool>* cancel);
    ~DeviceSession();

    /// Finds and opens a device; none may be open. Returns empty, or one line with the reason. If the driver
    /// has not answered in time, a later call with the same request gets the device.
    std::string open(const DeviceRequest& request, TimeLimit limit);

    /// Whether the last open() failed because the device is not there, or has no outputs.
    bool isMissing() const noexcept { return isMissing_; }

    /// From now on the device calls `owner`; its first call (about to start) comes before this returns.
    void start(AudioDeviceCallback& owner);
    void restart(); ///< with the device's current settings
    /// Stops calling the owner and returns when the render thread has left it; the device then plays silence.
    void detach() noexcept;
    /// Returns when the render thread has left the block it was in.
    void awaitBlock() const noexcept;

    /// A device that is not closed within `limit` is abandoned to its thread.
    void close(TimeLimit limit = closeLimit);
    static constexpr TimeLimit closeLimit{250};

    AudioDevice* device() const noexcept { return found_.device.get(); } ///< null: none is open
    std::string fullName() const { return found_.fullName(); }

private:
    struct Opening;
    using Clock = DeviceThread::Clock;
    bool awaitIdle(Clock::time_point deadline, const std::atomic<bool>* cancel);
    void closeOnThread(FoundDevice& found);

    AudioDrivers drivers_;
    const std::atomic<bool>* const cancel_;
    FoundDevice found_;
    std::shared_ptr<DetachableCallback> callback_;
    std::shared_ptr<Opening> opening_;           // until its result is used
    std::shared_ptr<FoundDevice> closingDevice_; // until the device is destroyed
    std::string busyDevice_;                     // device that the thread works on
    bool isMissing_ = false;
    bool hasTimedOut_ = false; // a call has exceeded its time limit
    DeviceThread thread_;
};

} // namespace physvib
