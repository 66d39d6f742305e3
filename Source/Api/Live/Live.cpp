// SPDX-License-Identifier: MIT
// The message thread of the live library, which owns the device.
#include "Api/Live/Live.h"
#include "Live/Devices/AudioDevice.h"
#include "Live/Devices/NoDevice.h"
#include "Live/Devices/SimulationDriver.h"
#include <utility>

namespace physvib::api {

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
    rig_.emplace(std::move(settings_), withNoDevice(systemAudioDrivers));
    if (std::string error = rig_->open(); error.empty()) {
        rig_->start();
        watch();
        opened.set_value({});
        repeatEvery(std::chrono::milliseconds{1000 / watchesPerSecond}, [this] { return watch(); });
        rig_->stop([](const PlayedEvent&) {});
        unsaved_ = rig_->finish(false); // before closing the device, which may hang
    } else {
        opened.set_value(std::move(error));
    }
    rig_.reset(); // on the thread that opened the device
}

bool Live::watch() {
    rig_->takePlayed([](const PlayedEvent&) {});
    if (ticks_++ % watchesPerSecond == 0) {
        rig_->maintain();
        trouble_ = rig_->trouble();
    }
    LiveStatus now{rig_->output().status(),
                   rig_->session().status().render,
                   rig_->output().sampleRateHz(),
                   rig_->output().blockFrames(),
                   rig_->output().device(),
                   rig_->sinkStates(),
                   trouble_};
    const std::lock_guard lock{statusMutex_};
    status_ = std::move(now);
    return !isEnding_;
}

} // namespace physvib::api
