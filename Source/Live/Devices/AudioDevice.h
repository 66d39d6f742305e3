// SPDX-License-Identifier: MIT
// Audio devices and their drivers, as this project uses them: the interface between the output and a library
// of devices.
#pragma once
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace physvib {

/// Channels of a device, from 0.
using ChannelSet = std::set<int>;

class AudioDevice;

/// What a device calls.
class DeviceUser {
public:
    virtual ~DeviceUser() = default;
    /// Before the first block, while start() runs.
    virtual void aboutToStart(AudioDevice& device) = 0;
    /// Fills all `outputs` channels of `out`: the active outputs, in order. R, wait-free.
    virtual void block(const float* const* in, int inputs, float* const* out, int outputs,
                       int frames) noexcept = 0;
    /// By AudioDevice::stop(), or because the device has failed. Any thread.
    virtual void stopped() = 0;
};

/// A device of a driver. One thread at a time; its calls may hang when the driver does.
class AudioDevice {
public:
    virtual ~AudioDevice() = default;

    virtual std::string name() const = 0;
    virtual int outputs() = 0; ///< that it has
    virtual int inputs() = 0;  ///< that it has
    virtual int defaultBlockFrames() = 0;

    /// Opens those of the channels that it has. 0: the device's default. Returns empty, or one line with the
    /// reason.
    virtual std::string open(const ChannelSet& inputs, const ChannelSet& outputs, int sampleRateHz,
                             int blockFrames) = 0;
    virtual void close() = 0;
    virtual bool isOpen() = 0;

    /// Asks `user` for blocks from now on.
    virtual void start(DeviceUser& user) = 0;
    /// No block runs afterwards.
    virtual void stop() = 0;

    /// Of the open device, at present.
    virtual int sampleRateHz() = 0;
    virtual int blockFrames() = 0;                ///< usual length of a block
    virtual ChannelSet activeOutputs() const = 0; ///< those that block() gets; empty: none is connected
    virtual int deviceLatencyFrames() = 0;
    virtual int xruns() const = 0; ///< -1: the device does not count. Any thread
    /// False: it discards what it gets, so nothing is lost while it pauses.
    virtual bool isReal() const { return true; }
};

/// Finds devices. One thread at a time.
class AudioDriver {
public:
    virtual ~AudioDriver() = default;
    virtual std::string name() const = 0; ///< "ALSA", "JACK", "CoreAudio"...
    virtual void scan() = 0;              ///< before the next two, which tell what it found
    virtual std::vector<std::string> deviceNames(bool inputs) = 0;
    /// The device with that output, and with the inputs of the same name if `withInputs`; null: there is
    /// none.
    virtual std::unique_ptr<AudioDevice> create(const std::string& name, bool withInputs) = 0;
};

/// Creates the drivers to search; they have not been scanned yet.
using AudioDrivers = std::function<std::vector<std::unique_ptr<AudioDriver>>()>;

} // namespace physvib
