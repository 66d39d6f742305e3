// SPDX-License-Identifier: MIT
// Lists, ranks and finds devices; runs calls that may hang on their own threads; and the null device, whose
// thread has an absolute deadline for each block.
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

std::atomic<int> abandonedCallCount{0};

// Time limit of a scan: JACK's library may block for ever if a program was killed while it opened a client.
constexpr std::chrono::seconds scanTimeOut{2};

std::vector<AudioDeviceName> scanDevices(AudioDriver& driver) {
    std::vector<AudioDeviceName> devices;
    driver.scan();
    for (const std::string& name : driver.deviceNames(false))
        if (const auto device = driver.create(name, false))
            devices.push_back({driver.name(), name, device->outputs()});
    return devices;
}

bool nameHasAny(const AudioDeviceName& device, std::initializer_list<const char*> words) {
    const std::string name = lowerCase(device.name);
    return std::ranges::any_of(
        words, [&](const char* word) { return name.find(lowerCase(word)) != std::string::npos; });
}

int likelihoodScore(const AudioDeviceName& device) {
    if (device.type == nullDeviceType) return -100;
    const int outputs = hardwareOutputCount(device);
    int score = outputs > 2 ? 50 : 10 * outputs;
    if (device.type == "JACK") score += 10;
    if (nameHasAny(device, {"DualSense"})) score += 5;
    if (isPico(device.name)) score += 20; // it has no other use
    if (nameHasAny(device, {"HDMI", "DisplayPort", "Monitor of"})) score -= 40;
    return score;
}

class NullDevice final : public AudioDevice {
public:
    ~NullDevice() override { close(); }

    std::string name() const override { return nullDeviceName; }
    int outputs() override { return limits::maxActuators; }
    int inputs() override { return 0; }
    int defaultBlockFrames() override { return 512; }
    std::string open(const ChannelSet&, const ChannelSet& outputs, int rateHz, int frames) override {
        close();
        active_ = outputs;
        rateHz_ = rateHz > 0 ? rateHz : 48000;
        blockFrames_ = std::clamp(frames > 0 ? frames : defaultBlockFrames(), 16, limits::maxBlockFrames);
        isOpen_ = true;
        return {};
    }
    void close() override {
        stop();
        isOpen_ = false;
    }
    bool isOpen() override { return isOpen_; }
    void start(AudioDeviceCallback& callback) override {
        stop();
        callback_ = &callback;
        callback.aboutToStart(*this);
        isEnding_ = false;
        thread_ = std::thread{[this] { run(); }};
    }
    void stop() override {
        isEnding_ = true;
        if (thread_.joinable()) thread_.join();
        if (auto* const former = std::exchange(callback_, nullptr)) former->stopped();
    }
    int sampleRateHz() override { return rateHz_; }
    int blockFrames() override { return blockFrames_; }
    ChannelSet activeOutputs() const override { return active_; }
    int deviceLatencyFrames() override { return 0; }
    int xruns() const override { return -1; }
    bool isReal() const override { return false; }

private:
    void run() {
        using Clock = std::chrono::steady_clock;
        raiseThreadPriority(true);
        std::vector<std::vector<float>> out(active_.size(),
                                            std::vector<float>(static_cast<std::size_t>(blockFrames_)));
        std::vector<float*> channels;
        for (auto& channel : out) channels.push_back(channel.data());
        const auto length = std::chrono::nanoseconds{static_cast<std::int64_t>(1e9 * blockFrames_ / rateHz_)};
        for (auto deadline = Clock::now(); !isEnding_; deadline += length) {
            // after a stall, the missed blocks are skipped instead of played in a burst
            if (const auto now = Clock::now(); now > deadline + 10 * length) deadline = now;
            std::this_thread::sleep_until(deadline);
            callback_->processBlock(nullptr, 0, channels.data(), static_cast<int>(channels.size()),
                                    blockFrames_);
        }
    }

    AudioDeviceCallback* callback_ = nullptr; // changes only while the thread does not run
    ChannelSet active_;
    int rateHz_ = 48000, blockFrames_ = 512;
    bool isOpen_ = false;
    std::atomic<bool> isEnding_{true};
    std::thread thread_;
};

class NullDriver final : public AudioDriver {
public:
    std::string name() const override { return nullDeviceType; }
    void scan() override {}
    std::vector<std::string> deviceNames(bool inputs) override {
        return inputs ? std::vector<std::string>{} : std::vector<std::string>{nullDeviceName};
    }
    std::unique_ptr<AudioDevice> create(const std::string& name, bool) override {
        return name == nullDeviceName ? std::make_unique<NullDevice>() : nullptr;
    }
};

} // namespace

struct DeviceThread::Call {
    std::mutex mutex;
    std::condition_variable changed;
    bool isOver = false, isAbandoned = false;
};

void DeviceThread::begin(std::function<void()> call) {
    abandon();
    if (needsOneThreadPerDriver()) return call();
    call_ = std::make_shared<Call>();
    thread_ = std::thread{[state = call_, call = std::move(call)]() mutable {
        call();
        call = nullptr; // destroys what it captured
        const std::lock_guard lock{state->mutex};
        state->isOver = true;
        if (state->isAbandoned) --abandonedCallCount;
        state->changed.notify_all();
    }};
}

bool DeviceThread::awaitEnd(Clock::time_point end, const std::atomic<bool>* cancel) {
    if (!call_) return true;
    {
        std::unique_lock lock{call_->mutex};
        while (!call_->isOver && Clock::now() < end && !(cancel && *cancel))
            call_->changed.wait_until(lock, std::min(end, Clock::now() + std::chrono::milliseconds{10}));
        if (!call_->isOver) return false;
    }
    thread_.join();
    call_.reset();
    return true;
}

void DeviceThread::abandon() {
    if (awaitEnd()) return;
    {
        const std::lock_guard lock{call_->mutex};
        call_->isAbandoned = true;
        if (!call_->isOver) ++abandonedCallCount;
    }
    thread_.detach();
    call_.reset();
}

int DeviceThread::abandonedThreads() noexcept { return abandonedCallCount; }

std::vector<AudioDeviceName> listAudioDevices(const AudioDrivers& drivers) {
    std::vector<AudioDeviceName> devices;
    for (auto& created : drivers()) {
        const std::shared_ptr<AudioDriver> driver = std::move(created);
        const auto found = std::make_shared<std::vector<AudioDeviceName>>();
        DeviceThread thread;
        thread.begin([driver, found] { *found = scanDevices(*driver); });
        if (thread.awaitEnd(DeviceThread::Clock::now() + scanTimeOut))
            std::ranges::move(*found, std::back_inserter(devices));
        else
            devices.push_back({driver->name(), "does not answer", 0});
    }
    return devices;
}

FoundDevice findAudioDevice(const AudioDrivers& drivers, const std::string& query, bool withInputs) {
    auto all = drivers();
    // older versions saved another name for the same outputs, which is not listed any more (AlsaDriver)
    const std::string target = query == "ALSA:JACK Audio Connection Kit" ? "JACK:system" : query;
    const auto prefix = [](const auto& driver) { return driver->name() + ":"; };
    const auto isWanted = [&](const auto& driver) { return target.starts_with(prefix(driver)); };
    const bool hasDriver = std::ranges::any_of(all, isWanted);
    for (auto& driver : all) {
        if (hasDriver && !isWanted(driver)) continue;
        driver->scan();
        std::string name = cleanLine(target.substr(hasDriver ? prefix(driver).size() : 0));
        const auto isListed = [&](bool inputs) {
            const auto names = driver->deviceNames(inputs);
            return std::ranges::find(names, name) != names.end();
        };
        if (name == picoDeviceName && !isListed(false)) name = findPico(driver->deviceNames(false));
        if (name.empty()) continue;
        auto device = driver->create(name, withInputs && isListed(true));
        if (device) return {std::move(driver), std::move(device)};
    }
    return {};
}

std::string picoLayoutPreset(const AudioDrivers& drivers, const std::string& name) {
    if (name != picoDeviceName) return parsePicoPreset(name);
    const auto found = findAudioDevice(drivers, name);
    return found.device ? parsePicoPreset(found.device->name()) : std::string{};
}

int hardwareOutputCount(const AudioDeviceName& device) {
    const bool isMixed = device.type == "ALSA" &&
                         nameHasAny(device, {"default", "pulse", "pipewire", "dmix", "front:", "surround"});
    return isMixed ? std::min(2, device.channels) : device.channels;
}

std::vector<AudioDeviceName> sortedByLikelihood(std::vector<AudioDeviceName> devices) {
    std::ranges::stable_sort(devices, std::greater{}, likelihoodScore);
    return devices;
}

const char* layoutPresetFor(int outputs, std::string_view device) {
    if (isPico(device) && outputs >= 4) return outputs >= 8 ? "pico8" : "pico4";
    return outputs >= 4 ? "phone4" : outputs == 3 ? "phone3" : outputs == 2 ? "phone2" : "phone1";
}

AudioDrivers withNullDevice(AudioDrivers drivers) {
    return [drivers = std::move(drivers)] {
        auto all = drivers();
        all.push_back(std::make_unique<NullDriver>());
        return all;
    };
}

} // namespace physvib
