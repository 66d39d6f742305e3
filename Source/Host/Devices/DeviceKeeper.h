// SPDX-License-Identifier: GPL-3.0-or-later
// One device of a system: found, opened, called and closed. What a driver may take for ever for (finding,
// opening, closing) is done on a thread of its own, for which nobody waits longer than he says.
#pragma once
#include "Host/Devices/AudioDevices.h"
#include "Host/Devices/DeviceCallback.h"
#include "Host/Devices/DeviceThread.h"
#include <atomic>
#include <chrono>
#include <memory>
#include <string>

namespace physvib {

/// What is wanted of a device.
struct DeviceWish {
    std::string name;                 ///< or type:name
    juce::BigInteger inputs, outputs; ///< outputs that it does not have are left out, as long as it has one
    int highestHeard = -1;            ///< an output that it has to have
    int sampleRateHz = 0, blockFrames = 0; ///< 0: as the device stands
    bool opensAll = false;                 ///< all its outputs

    bool operator==(const DeviceWish&) const = default;

    /// Empty, or what the device lacks. M, or the thread that opens it.
    std::string fault(juce::AudioIODevice& device) const;
};

/// All methods: M.
class DeviceKeeper {
public:
    using Limit = std::chrono::milliseconds;

    /// `hurry`, if there is one, ends all waiting when it is true, but that of close(); it outlives the
    /// keeper.
    DeviceKeeper(AudioDeviceTypes types, const std::atomic<bool>* hurry);
    ~DeviceKeeper();

    /// Finds and opens a device; none is open. Empty, or one line with the reason; it may be that the driver
    /// has not answered yet: when it does, the next call of the same wish has the device.
    std::string open(const DeviceWish& wish, Limit limit);

    /// `owner` is called from now on. It is told of the device before this returns.
    void start(juce::AudioIODeviceCallback& owner);
    void restart(); ///< with what the device is now
    /// The owner is called no more, and R has left it; what the device asks for is silence.
    void letGo() noexcept;
    /// R has left the block that it was in.
    void awaitBlock() const noexcept;

    /// A device that is not closed within `limit` is left to its thread.
    void close(Limit limit = closing);
    static constexpr Limit closing{250};

    juce::AudioIODevice* device() const noexcept { return found_.device.get(); } ///< null: none is open
    std::string fullName() const { return found_.fullName(); }

private:
    struct Opening;
    using Clock = DeviceThread::Clock;
    bool isIdle(Clock::time_point end, const std::atomic<bool>* hurry);
    void drop(FoundDevice& found);

    AudioDeviceTypes types_;
    const std::atomic<bool>* const hurry_;
    FoundDevice found_;
    std::shared_ptr<DeviceCallback> callback_;
    std::shared_ptr<Opening> opening_;    // until its result is taken
    std::shared_ptr<FoundDevice> closed_; // until it is destroyed
    std::string at_;                      // what the thread is at
    bool isLate_ = false;                 // by more than somebody waited
    DeviceThread thread_;
};

} // namespace physvib
