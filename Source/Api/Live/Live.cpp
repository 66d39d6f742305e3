// SPDX-License-Identifier: GPL-3.0-or-later
// The message thread of the live library: runs JUCE's message loop and owns the device.
#include "Api/Live/Live.h"
#include "Host/Devices/NoDevice.h"
#include <utility>

namespace physvib::api {

// Passes on played events, supervises the device, and ends the message loop.
class Live::Watch final : private juce::Timer {
public:
    explicit Watch(Live& live)
        : live_{live} {
        timerCallback();
        startTimer(milliseconds);
    }
    ~Watch() override { stopTimer(); }

private:
    static constexpr int milliseconds = 20;

    void timerCallback() override {
        Rig& rig = *live_.rig_;
        rig.takePlayed([](const PlayedEvent&) {});
        if (ticks_++ % (1000 / milliseconds) == 0) {
            rig.maintain();
            trouble_ = rig.trouble();
        }
        LiveStatus now{rig.output().status(),
                       rig.session().status().render,
                       rig.output().sampleRateHz(),
                       rig.output().blockFrames(),
                       rig.sinkStates(),
                       trouble_};
        const std::lock_guard lock{live_.statusMutex_};
        live_.status_ = std::move(now);
        if (live_.isEnding_) juce::MessageManager::getInstance()->stopDispatchLoop();
    }

    Live& live_;
    int ticks_ = 0;
    std::string trouble_;
};

std::string Live::open() {
    std::promise<std::string> opened;
    auto told = opened.get_future();
    messages_ = std::thread{[this, opened = std::move(opened)]() mutable { run(std::move(opened)); }};
    return told.get();
}

std::string Live::end() {
    isEnding_ = true;
    if (messages_.joinable()) messages_.join();
    return unsaved_;
}

LiveStatus Live::status() const {
    const std::lock_guard lock{statusMutex_};
    return status_;
}

void Live::run(std::promise<std::string> opened) {
    const juce::ScopedJuceInitialiser_GUI juce;
    rig_.emplace(std::move(settings_), audioDeviceTypesAndNone);
    if (std::string error = rig_->open(); error.empty()) {
        rig_->start();
        {
            const Watch watch{*this};
            opened.set_value({});
            juce::MessageManager::getInstance()->runDispatchLoop();
        }
        rig_->stop([](const PlayedEvent&) {});
        unsaved_ = rig_->finish(false); // before closing the device, which may hang
    } else {
        opened.set_value(std::move(error));
    }
    rig_.reset(); // before JUCE shuts down
}

} // namespace physvib::api
