// SPDX-License-Identifier: GPL-3.0-or-later
// Audio interfaces without hardware: they can be plugged in and out, come back with another rate, block and
// number of outputs, fail, fall silent, hang, and ask for blocks that they never announced.
#pragma once
#include "Live/Devices/AudioDevice.h"
#include "Live/Session/Session.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>

namespace physvib::test {

class FakeDevice;

/// The thing on the table. M changes it while nobody plays on it; play() is its own thread's business.
struct FakeInterface {
    std::string name = "hands";
    bool isPlugged = true, opens = true;
    int rate = 48000, block = 64, outputs = 8, inputs = 0;
    std::vector<int> unconnected; ///< outputs that the callback does not get
    bool isReal = false;          ///< its pauses count, in real time
    int withheld = 0;             ///< outputs that the callback does not get although they are active
    int timesOpened = 0, timesStarted = 0;
    ChannelSet opened;
    FakeDevice* device = nullptr;
    std::mutex mutex; // as drivers do: held during a callback and while the callback changes

    /// That call, and each after it, comes back after goOn() only, as of a driver whose server is stopped.
    enum class Call { none, scan, open, close };
    std::atomic<Call> hangsIn{Call::none};
    void goOn() {
        hangsIn = Call::none;
        hangsIn.notify_all();
    }
    void hang(Call call) { hangsIn.wait(call); }

    /// What happens while somebody waits for blocks, and asks after each pause: no second thread, no time.
    std::function<void()> whenAsked;

    /// One block of what comes out, a vector per connected output; those nobody writes keep `untouched`.
    static constexpr float untouched = 7.0f;
    std::vector<std::vector<float>> play(int frames);
    void unplug(bool tells);
};

class FakeDevice final : public AudioDevice {
public:
    explicit FakeDevice(FakeInterface& thing)
        : thing_{thing}
        , name_{thing.name} {}
    ~FakeDevice() override { close(); }

    std::string name() const override { return name_; }
    int outputs() override { return thing_.outputs; }
    int inputs() override { return thing_.inputs; }
    int defaultBlockFrames() override { return thing_.block; }
    std::string open(const ChannelSet&, const ChannelSet& outputs, int, int) override {
        thing_.hang(FakeInterface::Call::open);
        ++thing_.timesOpened;
        if (!thing_.opens) return "busy";
        const std::lock_guard lock{thing_.mutex};
        thing_.opened = outputs;
        thing_.device = this;
        return {};
    }
    void close() override {
        thing_.hang(FakeInterface::Call::close);
        stop();
        const std::lock_guard lock{thing_.mutex};
        if (thing_.device == this) thing_.device = nullptr;
    }
    bool isOpen() override { return thing_.device == this; }
    void start(AudioDeviceCallback& user) override {
        ++thing_.timesStarted;
        user.aboutToStart(*this);
        const std::lock_guard lock{thing_.mutex};
        user_ = &user;
    }
    void stop() override {
        if (auto* const old = take()) old->stopped();
    }
    int sampleRateHz() override { return thing_.rate; }
    int blockFrames() override { return thing_.block; }
    ChannelSet activeOutputs() const override {
        auto active = thing_.opened;
        for (const int k : thing_.unconnected) active.erase(k);
        return active;
    }
    int deviceLatencyFrames() override { return thing_.block; }
    int xruns() const override {
        if (thing_.whenAsked) thing_.whenAsked();
        return -1;
    }
    bool isReal() const override { return thing_.isReal; }
    AudioDeviceCallback* user() const { return user_; }

private:
    AudioDeviceCallback* take() {
        const std::lock_guard lock{thing_.mutex};
        return std::exchange(user_, nullptr);
    }
    FakeInterface& thing_;
    std::string name_;
    AudioDeviceCallback* user_ = nullptr;
};

inline std::vector<std::vector<float>> FakeInterface::play(int frames) {
    const std::lock_guard lock{mutex};
    if (device == nullptr || device->user() == nullptr) return {};
    const std::size_t count = device->activeOutputs().size() - static_cast<std::size_t>(withheld);
    std::vector<std::vector<float>> out(count,
                                        std::vector<float>(static_cast<std::size_t>(frames), untouched));
    std::vector<float*> at;
    for (auto& channel : out) at.push_back(channel.data());
    device->user()->processBlock(nullptr, 0, at.data(), static_cast<int>(count), frames);
    return out;
}

/// Gone from the list; a driver that `tells` says so as well, others just call no more.
inline void FakeInterface::unplug(bool tells) {
    isPlugged = false;
    if (tells && device != nullptr && device->user() != nullptr) device->user()->stopped();
}

class FakeDriver final : public AudioDriver {
public:
    FakeDriver(std::vector<FakeInterface*> things, std::string name)
        : things_{std::move(things)}
        , name_{std::move(name)} {}
    std::string name() const override { return name_; }
    void scan() override {
        names_.clear();
        for (auto* thing : things_) {
            thing->hang(FakeInterface::Call::scan);
            if (thing->isPlugged) names_.push_back(thing->name);
        }
    }
    std::vector<std::string> deviceNames(bool inputs) override {
        return inputs ? std::vector<std::string>{} : names_;
    }
    std::unique_ptr<AudioDevice> create(const std::string& name, bool) override {
        const auto thing = std::find_if(things_.begin(), things_.end(),
                                        [&](const auto* t) { return t->isPlugged && t->name == name; });
        return thing == things_.end() ? nullptr : std::make_unique<FakeDevice>(**thing);
    }

private:
    std::vector<FakeInterface*> things_;
    std::string name_;
    std::vector<std::string> names_;
};

/// A system with these interfaces on one driver.
inline AudioDrivers fakeDrivers(std::vector<FakeInterface*> things, const std::string& driver = "Fake") {
    return [=] {
        std::vector<std::unique_ptr<AudioDriver>> drivers;
        drivers.push_back(std::make_unique<FakeDriver>(things, driver));
        return drivers;
    };
}

using Signals = std::vector<std::vector<float>>; // one per output

/// So many blocks of a session on an interface: what came out, per connected output. `use` gets each event.
template <class Use>
Signals playBlocks(Session& session, FakeInterface& interface, int blocks, int frames, Use use) {
    Signals all;
    for (; blocks > 0; --blocks) {
        session.advance();
        const auto block = interface.play(frames);
        all.resize(block.size());
        for (std::size_t k = 0; k < block.size(); ++k)
            all[k].insert(all[k].end(), block[k].begin(), block[k].end());
        for (PlayedEvent played; session.played().pop(played);) use(played.event);
    }
    return all;
}

inline float peakOf(const std::vector<float>& samples) {
    float most = 0.0f;
    for (const float s : samples) // what is no number is as loud as can be
        most = std::max(most, std::isnan(s) ? std::numeric_limits<float>::infinity() : std::abs(s));
    return most;
}
inline float peakOf(const Signals& outputs) {
    float most = 0.0f;
    for (const auto& samples : outputs) most = std::max(most, peakOf(samples));
    return most;
}

} // namespace physvib::test
