// SPDX-License-Identifier: MIT
// Scans drivers for their output devices; runs calls that may hang on threads of their own; the null device,
// with one absolute deadline per block.
#include "Live/Devices/AudioDevice.h"
#include "Core/Limits.h"
#include "Io/Text/CleanText.h"
#include "Live/Session/System.h"
#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace physvib {

namespace {

std::atomic<int> left{0};

// Time limit of a scan: JACK's library may block for ever if a program was killed while it opened a client.
constexpr std::chrono::seconds answering{2};

std::vector<AudioDeviceName> devicesOf(AudioDriver& driver) {
    std::vector<AudioDeviceName> devices;
    driver.scan();
    for (const std::string& name : driver.deviceNames(false))
        if (const auto device = driver.create(name, false))
            devices.push_back({driver.name(), name, device->outputs()});
    return devices;
}

bool says(const AudioDeviceName& device, std::initializer_list<const char*> words) {
    const std::string name = lowerCase(device.name);
    return std::ranges::any_of(
        words, [&](const char* word) { return name.find(lowerCase(word)) != std::string::npos; });
}

int likelihood(const AudioDeviceName& device) {
    if (device.type == noDeviceType) return -100;
    const int outputs = ownOutputs(device);
    int points = outputs > 2 ? 50 : 10 * outputs;
    if (device.type == "JACK") points += 10;
    if (says(device, {"DualSense"})) points += 5;
    if (isPico(device.name)) points += 20; // it has no other use
    if (says(device, {"HDMI", "DisplayPort", "Monitor of"})) points -= 40;
    return points;
}

class NoDevice final : public AudioDevice {
public:
    ~NoDevice() override { close(); }

    std::string name() const override { return noDeviceName; }
    int outputs() override { return limits::maxEnchanters; }
    int inputs() override { return 0; }
    int defaultBlockFrames() override { return 512; }
    std::string open(const ChannelSet&, const ChannelSet& outputs, int rate, int block) override {
        close();
        active_ = outputs;
        rate_ = rate > 0 ? rate : 48000;
        block_ = std::clamp(block > 0 ? block : defaultBlockFrames(), 16, limits::maxBlockFrames);
        isOpen_ = true;
        return {};
    }
    void close() override {
        stop();
        isOpen_ = false;
    }
    bool isOpen() override { return isOpen_; }
    void start(DeviceUser& user) override {
        stop();
        user_ = &user;
        user.aboutToStart(*this);
        ends_ = false;
        thread_ = std::thread{[this] { run(); }};
    }
    void stop() override {
        ends_ = true;
        if (thread_.joinable()) thread_.join();
        if (auto* const old = std::exchange(user_, nullptr)) old->stopped();
    }
    int sampleRateHz() override { return rate_; }
    int blockFrames() override { return block_; }
    ChannelSet activeOutputs() const override { return active_; }
    int deviceLatencyFrames() override { return 0; }
    int xruns() const override { return -1; }
    bool isReal() const override { return false; }

private:
    void run() {
        using Clock = std::chrono::steady_clock;
        raiseThreadPriority(true);
        std::vector<std::vector<float>> out(active_.size(),
                                            std::vector<float>(static_cast<std::size_t>(block_)));
        std::vector<float*> at;
        for (auto& channel : out) at.push_back(channel.data());
        const auto length = std::chrono::nanoseconds{static_cast<std::int64_t>(1e9 * block_ / rate_)};
        for (auto deadline = Clock::now(); !ends_; deadline += length) {
            // after a stall, the missed blocks are skipped instead of played in a burst
            if (const auto now = Clock::now(); now > deadline + 10 * length) deadline = now;
            std::this_thread::sleep_until(deadline);
            user_->block(nullptr, 0, at.data(), static_cast<int>(at.size()), block_);
        }
    }

    DeviceUser* user_ = nullptr; // changes only while the thread does not run
    ChannelSet active_;
    int rate_ = 48000, block_ = 512;
    bool isOpen_ = false;
    std::atomic<bool> ends_{true};
    std::thread thread_;
};

class NoDeviceDriver final : public AudioDriver {
public:
    std::string name() const override { return noDeviceType; }
    void scan() override {}
    std::vector<std::string> deviceNames(bool inputs) override {
        return inputs ? std::vector<std::string>{} : std::vector<std::string>{noDeviceName};
    }
    std::unique_ptr<AudioDevice> create(const std::string& name, bool) override {
        return name == noDeviceName ? std::make_unique<NoDevice>() : nullptr;
    }
};

} // namespace

struct DeviceThread::Call {
    std::mutex mutex;
    std::condition_variable changed;
    bool isOver = false, isLeft = false;
};

void DeviceThread::begin(std::function<void()> call) {
    leave();
    if (areDriversBoundToTheirThread()) return call();
    call_ = std::make_shared<Call>();
    thread_ = std::thread{[state = call_, call = std::move(call)]() mutable {
        call();
        call = nullptr; // destroys what it captured
        const std::lock_guard lock{state->mutex};
        state->isOver = true;
        if (state->isLeft) --left;
        state->changed.notify_all();
    }};
}

bool DeviceThread::isOver(Clock::time_point end, const std::atomic<bool>* hurry) {
    if (!call_) return true;
    {
        std::unique_lock lock{call_->mutex};
        while (!call_->isOver && Clock::now() < end && !(hurry && *hurry))
            call_->changed.wait_until(lock, std::min(end, Clock::now() + std::chrono::milliseconds{10}));
        if (!call_->isOver) return false;
    }
    thread_.join();
    call_.reset();
    return true;
}

void DeviceThread::leave() {
    if (isOver()) return;
    {
        const std::lock_guard lock{call_->mutex};
        call_->isLeft = true;
        if (!call_->isOver) ++left;
    }
    thread_.detach();
    call_.reset();
}

int DeviceThread::threadsLeft() noexcept { return left; }

std::vector<AudioDeviceName> listAudioDevices(const AudioDrivers& drivers) {
    std::vector<AudioDeviceName> devices;
    for (auto& each : drivers()) {
        const std::shared_ptr<AudioDriver> driver = std::move(each);
        const auto found = std::make_shared<std::vector<AudioDeviceName>>();
        DeviceThread thread;
        thread.begin([driver, found] { *found = devicesOf(*driver); });
        if (thread.isOver(DeviceThread::Clock::now() + answering))
            std::ranges::move(*found, std::back_inserter(devices));
        else
            devices.push_back({driver->name(), "does not answer", 0});
    }
    return devices;
}

FoundDevice findAudioDevice(const AudioDrivers& drivers, const std::string& asked, bool withInputs) {
    auto all = drivers();
    // older versions saved another name for the same outputs, which is not listed any more (AlsaDriver)
    const std::string wanted = asked == "ALSA:JACK Audio Connection Kit" ? "JACK:system" : asked;
    const auto prefix = [](const auto& driver) { return driver->name() + ":"; };
    const auto isNamed = [&](const auto& driver) { return wanted.starts_with(prefix(driver)); };
    const bool hasDriver = std::ranges::any_of(all, isNamed);
    for (auto& driver : all) {
        if (hasDriver && !isNamed(driver)) continue;
        driver->scan();
        std::string name = cleanLine(wanted.substr(hasDriver ? prefix(driver).size() : 0));
        const auto has = [&](bool inputs) {
            const auto names = driver->deviceNames(inputs);
            return std::ranges::find(names, name) != names.end();
        };
        if (name == picoDeviceName && !has(false)) name = picoAmong(driver->deviceNames(false));
        if (name.empty()) continue;
        auto device = driver->create(name, withInputs && has(true));
        if (device) return {std::move(driver), std::move(device)};
    }
    return {};
}

std::string picoLayout(const AudioDrivers& drivers, const std::string& name) {
    if (name != picoDeviceName) return picoLayoutOf(name);
    const auto found = findAudioDevice(drivers, name);
    return found.device ? picoLayoutOf(found.device->name()) : std::string{};
}

// Scores devices by name and number of outputs, without opening any.

int ownOutputs(const AudioDeviceName& device) {
    const bool isMixed =
        device.type == "ALSA" && says(device, {"default", "pulse", "pipewire", "dmix", "front:", "surround"});
    return isMixed ? std::min(2, device.channels) : device.channels;
}

std::vector<AudioDeviceName> byLikelihood(std::vector<AudioDeviceName> devices) {
    std::ranges::stable_sort(devices, std::greater{}, likelihood);
    return devices;
}

const char* layoutFor(int outputs, std::string_view device) {
    if (isPico(device) && outputs >= 4) return outputs >= 8 ? "pico8" : "pico4";
    return outputs >= 4 ? "phone4" : outputs == 3 ? "phone3" : outputs == 2 ? "phone2" : "phone1";
}

AudioDrivers withNoDevice(AudioDrivers drivers) {
    return [drivers = std::move(drivers)] {
        auto all = drivers();
        all.push_back(std::make_unique<NoDeviceDriver>());
        return all;
    };
}

} // namespace physvib
