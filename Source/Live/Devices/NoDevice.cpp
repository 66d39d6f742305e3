// SPDX-License-Identifier: MIT
// The null device's thread, with one absolute deadline per block.
#include "Live/Devices/NoDevice.h"
#include "Core/Limits.h"
#include "Live/Session/ThisThread.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

namespace physvib {

namespace {

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

std::unique_ptr<AudioDriver> makeNoDeviceDriver() { return std::make_unique<NoDeviceDriver>(); }

AudioDrivers withNoDevice(AudioDrivers drivers) {
    return [drivers = std::move(drivers)] {
        auto all = drivers();
        all.push_back(makeNoDeviceDriver());
        return all;
    };
}

} // namespace physvib
