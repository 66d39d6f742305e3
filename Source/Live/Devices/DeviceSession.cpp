// SPDX-License-Identifier: MIT
// Opens and closes a device on the device thread, and handles calls of the driver that finish after their
// time limit.
#include "Live/Devices/DeviceSession.h"
#include <utility>

namespace physvib {

struct DeviceSession::Opening {
    DeviceRequest wish;
    AudioDrivers drivers;
    FoundDevice found{};
    std::string error{};
    bool isMissing = false;

    void open();
    std::string openFound();
};

std::string DeviceRequest::fault(AudioDevice& device) const {
    const int offered = device.outputs();
    if (highestHeard >= offered)
        return name + ": has " + std::to_string(offered) +
               " outputs; expected one of them to listen to or for marks, found output " +
               std::to_string(highestHeard + 1);
    if (inputs.empty()) return {};
    const int wanted = *inputs.rbegin(), has = device.inputs();
    return wanted < has ? ""
                        : name + ": has " + std::to_string(has) +
                              " inputs; expected one of them, found input " + std::to_string(wanted + 1);
}

void DeviceSession::Opening::open() {
    found = findAudioDevice(drivers, wish.name, !wish.inputs.empty());
    error = found.device ? openFound()
                         : wish.name + ": no such device (see physvib devices); nothing else is played on";
    if (error.empty()) return;
    isMissing = isMissing || !found.device;
    found.device.reset(); // before its driver
    found.driver.reset();
}

std::string DeviceSession::Opening::openFound() {
    auto& device = *found.device;
    if (auto fault = wish.fault(device); !fault.empty()) return fault;
    const int offered = device.outputs();
    ChannelSet outputs = wish.outputs;
    outputs.erase(outputs.lower_bound(offered), outputs.end());
    for (int k = 0; wish.opensAll && k < offered; ++k) outputs.insert(k);
    isMissing = outputs.empty();
    if (isMissing) return wish.name + ": has none of the outputs that are wanted";
    const auto fault = device.open(wish.inputs, outputs, wish.sampleRateHz, wish.blockFrames);
    return fault.empty() ? "" : wish.name + ": " + fault;
}

DeviceSession::DeviceSession(AudioDrivers drivers, const std::atomic<bool>* hurry)
    : drivers_{std::move(drivers)}
    , hurry_{hurry} {}

DeviceSession::~DeviceSession() {
    if (found_.device || opening_) close();
}

std::string DeviceSession::open(const DeviceRequest& wish, Limit limit) {
    const auto end = isLate_ ? Clock::time_point{} : Clock::now() + limit; // after one time-out, later calls
                                                                           // only check and do not wait
    isLate_ = true;
    isMissing_ = false;
    const std::string noAnswer = wish.name + ": its driver does not answer; nothing else is played on";
    if (!isIdle(end, hurry_)) {
        if (at_ == wish.name) return noAnswer;
        thread_.leave(); // another device may have a driver that answers
        opening_.reset();
        closed_.reset();
    }
    if (opening_ && opening_->wish != wish) drop(std::exchange(opening_, nullptr)->found);
    if (!opening_ && isIdle(Clock::now() + limit, hurry_)) {
        opening_ = std::make_shared<Opening>(Opening{wish, drivers_});
        at_ = wish.name;
        thread_.begin([opening = opening_] { opening->open(); });
    }
    if (!opening_ || !isIdle(Clock::now() + limit, hurry_)) return noAnswer;
    isLate_ = false;
    const auto opened = std::exchange(opening_, nullptr);
    found_ = std::move(opened->found);
    isMissing_ = opened->isMissing;
    return opened->error;
}

void DeviceSession::start(DeviceUser& owner) {
    callback_ = std::make_shared<DeviceCallback>(owner);
    found_.device->start(*callback_);
}

void DeviceSession::restart() {
    found_.device->stop();
    found_.device->start(*callback_);
}

void DeviceSession::letGo() noexcept {
    if (callback_) callback_->letGo();
}

void DeviceSession::awaitBlock() const noexcept {
    if (callback_) callback_->awaitBlock();
}

void DeviceSession::close(Limit limit) {
    letGo();
    if (opening_ && isIdle({}, nullptr))
        found_ = std::move(std::exchange(opening_, nullptr)->found); // opened after the time limit
    drop(found_);
    isIdle(Clock::now() + limit, nullptr);
}

void DeviceSession::drop(FoundDevice& found) {
    if (!found.device) return;
    at_ = found.fullName();
    closed_ = std::make_shared<FoundDevice>(std::move(found));
    thread_.begin([closed = closed_, callback = std::exchange(callback_, nullptr)] {
        closed->device->stop();
        closed->device->close();
    });
}

// Devices are destroyed while M waits, because a driver may receive notifications on the message loop.
bool DeviceSession::isIdle(Clock::time_point end, const std::atomic<bool>* hurry) {
    if (!thread_.isOver(end, hurry)) return false;
    if (!closed_) return true;
    thread_.begin([closed = std::exchange(closed_, nullptr)] {
        closed->device.reset(); // before its driver
        closed->driver.reset();
    });
    return thread_.isOver(end, hurry);
}

} // namespace physvib
