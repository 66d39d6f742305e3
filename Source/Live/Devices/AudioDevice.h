// SPDX-License-Identifier: MIT
// Interfaces of audio devices and drivers; lists of devices, and their ranking; a thread for calls that may
// hang; the null device; the Raspberry Pi Pico. Threads: M, the message thread; R, the render thread.
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

/// Gets the calls of a device; implemented by the object that plays on it.
class AudioDeviceCallback {
public:
    virtual ~AudioDeviceCallback() = default;
    /// Called by start() before the first block.
    virtual void aboutToStart(AudioDevice& device) = 0;
    /// Fills all `outputs` channels of `out`, which are the active outputs in order. R, wait-free.
    virtual void processBlock(const float* const* in, int inputs, float* const* out, int outputs,
                              int frames) noexcept = 0;
    /// Called by AudioDevice::stop(), or when the device has failed. Any thread.
    virtual void stopped() = 0;
};

/// A device of a driver. One thread at a time; its calls may hang when the driver does.
class AudioDevice {
public:
    virtual ~AudioDevice() = default;

    virtual std::string name() const = 0;
    virtual int outputs() = 0; ///< number of outputs of the device
    virtual int inputs() = 0;  ///< number of inputs of the device
    virtual int defaultBlockFrames() = 0;

    /// Opens the channels that exist; a rate or block of 0 is the default. Returns empty, or the error.
    virtual std::string open(const ChannelSet& inputs, const ChannelSet& outputs, int sampleRateHz,
                             int blockFrames) = 0;
    virtual void close() = 0;
    virtual bool isOpen() = 0;

    /// Asks `callback` for blocks from now on.
    virtual void start(AudioDeviceCallback& callback) = 0;
    /// When it returns, no block is being rendered and none will be.
    virtual void stop() = 0;

    /// The methods up to xruns() describe the device while it is open.
    virtual int sampleRateHz() = 0;
    virtual int blockFrames() = 0;                ///< nominal length of a block
    virtual ChannelSet activeOutputs() const = 0; ///< those of processBlock(); empty: none is connected
    virtual int deviceLatencyFrames() = 0;
    virtual int xruns() const = 0; ///< -1: the device does not count. Any thread
    /// False for a device that discards its samples, so that nothing is lost while it pauses.
    virtual bool isReal() const { return true; }
};

/// Finds devices. One thread at a time.
class AudioDriver {
public:
    virtual ~AudioDriver() = default;
    virtual std::string name() const = 0; ///< "ALSA", "JACK", "CoreAudio"...
    virtual void scan() = 0;              ///< lists the devices for the next two methods
    virtual std::vector<std::string> deviceNames(bool inputs) = 0;
    /// The device with that output, and with the same name's inputs if `withInputs`; null: there is none.
    virtual std::unique_ptr<AudioDevice> create(const std::string& name, bool withInputs) = 0;
};

/// Creates the drivers to search; they have not been scanned yet.
using AudioDrivers = std::function<std::vector<std::unique_ptr<AudioDriver>>()>;

// Forwards the blocks of a device to a callback, which can be detached without a lock in the render thread.

class CallbackSlot {
public:
    CallbackSlot() = default;
    explicit CallbackSlot(AudioDeviceCallback& callback) noexcept
        : callback_{&callback} {}

    /// Blocks go to `callback` from now on. M.
    void begin(AudioDevice& device, AudioDeviceCallback& callback) {
        callback.aboutToStart(device);
        callback_ = &callback;
    }

    /// Detaches the callback and returns it, if any, when the render thread has left its last block. M.
    AudioDeviceCallback* end() noexcept {
        AudioDeviceCallback* const callback = callback_.exchange(nullptr);
        awaitBlock();
        return callback;
    }

    /// Returns when the render thread has left the block it was in, if any. M.
    void awaitBlock() const noexcept {
        while (calls_ > 0) std::this_thread::sleep_for(std::chrono::milliseconds{1}); // at most for one block
    }

    /// Calls `function` with the callback, or null if the device is not started; end() waits for this call.
    /// R, wait-free if `function` is.
    template <class Function>
    void call(const Function& function) {
        ++calls_; // sequentially consistent, as callback_: this call sees the null, or end() sees it
        function(callback_.load());
        --calls_;
    }

private:
    std::atomic<AudioDeviceCallback*> callback_{nullptr};
    std::atomic<int> calls_{0};
};

// Lists the audio output devices of drivers, and finds one of them by its name.

/// One output device of one driver.
struct AudioDeviceName {
    std::string type; ///< "ALSA", "JACK", "CoreAudio"...
    std::string name;
    int channels = 0; ///< number of outputs; 0 if the driver could not be queried
};

/// All output devices, including those that another program has open. A driver that does not answer within
/// two seconds gets an entry without outputs that says so. M; scans the drivers, which takes a while.
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
/// it is no Pico. M; scans drivers for `pico` alone.
std::string picoLayoutPreset(const AudioDrivers& drivers, const std::string& name);

// Ranks devices by how likely the actuators are connected to them.

/// Number of outputs that reach the hardware one to one. A device that mixes for a sound server counts as
/// two at most, whatever it reports. Any thread.
int hardwareOutputCount(const AudioDeviceName& device);

/// Sorted by likelihood: many outputs before few, a Pico and a running JACK server before other devices,
/// displays and "no device" last. Any thread.
std::vector<AudioDeviceName> sortedByLikelihood(std::vector<AudioDeviceName> devices);

/// The layout preset for that many outputs, at most four; a Pico's own for its four or eight. Any thread.
const char* layoutPresetFor(int outputs, std::string_view device = {});

// The audio drivers of this system.

/// In the order in which names are searched. M.
std::vector<std::unique_ptr<AudioDriver>> systemAudioDrivers();

// Thread for calls of an audio driver that may hang; the caller waits for a limited time only.

/// One call at a time. M, except abandonedThreads().
class DeviceThread {
public:
    DeviceThread() = default;
    /// A call that has not finished is abandoned to its thread.
    ~DeviceThread() { abandon(); }
    DeviceThread(const DeviceThread&) = delete;
    DeviceThread& operator=(const DeviceThread&) = delete;

    /// Starts `call`, which must own or share everything it uses. The previous call must have finished.
    void begin(std::function<void()> call);

    using Clock = std::chrono::steady_clock;
    /// Waits for the call until `end`, or until `cancel` (may be null) is true. True: it has finished.
    bool awaitEnd(Clock::time_point end = {}, const std::atomic<bool>* cancel = nullptr);

    /// Allows another call to start; a call that has not finished goes on in its thread, which is detached.
    void abandon();

    /// Number of abandoned calls of this process that are still running. While there are any, a program exits
    /// without destructors of static objects, which such a thread may still use (endProgram). Any thread.
    static int abandonedThreads() noexcept;

private:
    struct Call;
    std::shared_ptr<Call> call_;
    std::thread thread_;
};

// Null audio device that asks for blocks by a steady clock and discards them. It lets a world run, be shown
// and be recorded on a machine without an audio interface.

/// The driver's name; its device is nullDeviceName.
inline constexpr const char* nullDeviceType = "None";
inline constexpr const char* nullDeviceName = "no device";

/// These drivers, and one with that device alone: 64 outputs, 48 kHz and blocks of 512 frames unless set
/// otherwise. M.
AudioDrivers withNullDevice(AudioDrivers drivers);

// The Raspberry Pi Pico (Docs/pico.md) among the audio devices: an ordinary sound card that is known by its
// product's name.

/// Finds the first Pico under any driver, as a device's name.
inline constexpr std::string_view picoDeviceName = "pico";

/// Part of its name under every operating system (Firmware/Pico/Usb.cpp), followed by 4 or 8 (outputs).
inline constexpr std::string_view picoProductName = "PhysVib pico";

/// From a USB packet to the first of its frames at the pins (Tests/Firmware/pico.sh). No driver reports it.
inline constexpr double picoLatencySeconds = 0.0028;

inline bool isPico(std::string_view device) {
    return device == picoDeviceName || device.find(picoProductName) != std::string_view::npos;
}

/// The Pico among a driver's devices; empty: there is none. ALSA lists parts of a card, too: the card itself
/// is preferred, because it has all its channels in their order. Any thread.
inline std::string findPico(const std::vector<std::string>& devices) {
    std::string found;
    for (const std::string& device : devices) {
        if (!isPico(device)) continue;
        if (device.find("Direct hardware device") != std::string::npos) return device;
        if (found.empty()) found = device;
    }
    return found;
}

/// The layout preset for the Pico with that name: "pico4", "pico8"; empty: the name does not say. Any thread.
inline std::string parsePicoPreset(std::string_view device) {
    const auto start = device.find(picoProductName);
    if (start == std::string_view::npos) return {};
    const std::string preset{device.substr(start + picoProductName.size() - picoDeviceName.size(), 5)};
    return preset == "pico4" || preset == "pico8" ? preset : std::string{};
}

} // namespace physvib
