// SPDX-License-Identifier: GPL-3.0-or-later
// The message thread: JUCE's, and so the device's, from its beginning to its end.
#include "Api/Live/Live.h"
#include "Host/Devices/SimulationDriver.h"
#include <utility>

namespace physvib::api {

// Empties what the session tells, keeps the device, ends the loop.
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
        for (PlayedEvent event; live_.session_.played().pop(event);) {}
        if (ticks_++ % (1000 / milliseconds) == 0) trouble_ = live_.output_->maintain();
        LiveStatus now{live_.output_->status(), live_.session_.status().render, live_.output_->sampleRateHz(), live_.output_->blockFrames(), trouble_};
        const std::lock_guard lock{live_.statusMutex_};
        live_.status_ = std::move(now);
        if (live_.isEnding_) juce::MessageManager::getInstance()->stopDispatchLoop();
    }

    Live& live_;
    int ticks_ = 0;
    std::string trouble_;
};

Live::Live(const SessionSetup& setup, AudioOutputSettings output)
    : session_{setup}
    , settings_{std::move(output)}
    , stepsPerSecond_{setup.stepsPerSecond} {}

Live::~Live() {
    isEnding_ = true;
    if (messages_.joinable()) messages_.join();
}

std::string Live::open() {
    std::promise<std::string> opened;
    auto told = opened.get_future();
    messages_ = std::thread{[this, opened = std::move(opened)]() mutable { run(std::move(opened)); }};
    return told.get();
}

LiveStatus Live::status() const {
    const std::lock_guard lock{statusMutex_};
    return status_;
}

void Live::run(std::promise<std::string> opened) {
    const juce::ScopedJuceInitialiser_GUI juce;
    output_.emplace(session_);
    {
        std::string error = output_->open(settings_);
        const bool isOpen = error.empty();
        std::optional<ThreadDriver> driver;
        std::optional<Watch> watch;
        if (isOpen) driver.emplace(session_, stepsPerSecond_), watch.emplace(*this);
        opened.set_value(std::move(error));
        if (isOpen) juce::MessageManager::getInstance()->runDispatchLoop();
    }
    output_.reset(); // before JUCE
}

} // namespace physvib::api
