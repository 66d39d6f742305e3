// SPDX-License-Identifier: MIT
// Audio devices and their drivers, as this project uses them: the interface between the output and a library
// of devices.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <thread>
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

    /// Opens those of the channels that it has. 0: the device's default. Empty, or one line why.
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
    /// The device with that output, and with the same name's inputs if `withInputs`; null: there is none.
    virtual std::unique_ptr<AudioDevice> create(const std::string& name, bool withInputs) = 0;
};

/// Creates the drivers to search; they have not been scanned yet.
using AudioDrivers = std::function<std::vector<std::unique_ptr<AudioDriver>>()>;

// Hands blocks of a device to whoever has started it, and ends that without a lock in the render thread.

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

// Lists the audio output devices of drivers, and finds one of them by its name.

/// One output device of one driver.
struct AudioDeviceName {
    std::string type; ///< "ALSA", "JACK", "CoreAudio"...
    std::string name;
    int channels = 0; ///< number of outputs; 0 if the driver could not be queried
};

/// All output devices that can be opened, or that another program has; of a driver that has not answered for
/// two seconds, an entry without outputs that says so. M; scans the drivers, which takes a while.
std::vector<AudioDeviceName> listAudioDevices(const AudioDrivers& drivers);

/// A device that is not open yet, and its driver, which must outlive the device.
struct FoundDevice {
    std::unique_ptr<AudioDriver> driver;
    std::unique_ptr<AudioDevice> device;

    /// "driver:name": identifies this device and no other.
    std::string fullName() const { return driver->name() + ":" + device->name(); }
};

/// The device with that name or driver:name, or the first Pico for `pico`; empty if there is none.
/// `withInputs`: opens inputs of the same name too, if there are any. M; scans drivers only until it finds
/// the device.
FoundDevice findAudioDevice(const AudioDrivers& drivers, const std::string& name, bool withInputs = false);

/// The layout preset of the Pico with that name, or of the one that `pico` finds: "pico4", "pico8"; empty:
/// that is no Pico. M; scans drivers for `pico` alone.
std::string picoLayout(const AudioDrivers& drivers, const std::string& name);

// Guesses which audio device the actuators are connected to.

/// Number of outputs that reach the hardware one to one. A device that mixes for a sound server counts as
/// two at most, whatever it reports. Any thread.
int ownOutputs(const AudioDeviceName& device);

/// Sorted by likelihood: many outputs before few, a Pico and a running JACK server before other devices,
/// displays and "no device" last. Any thread.
std::vector<AudioDeviceName> byLikelihood(std::vector<AudioDeviceName> devices);

/// The layout preset for that many outputs, at most four; a Pico's own for its four or eight. Any thread.
const char* layoutFor(int outputs, std::string_view device = {});

// The audio drivers of this system.

/// In the order in which names are searched. M.
std::vector<std::unique_ptr<AudioDriver>> systemAudioDrivers();

} // namespace physvib
