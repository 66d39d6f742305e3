// SPDX-License-Identifier: MIT
// Opens and closes a device on the device thread, and handles calls of the driver that finish after their
// time limit.
#include "Live/Devices/DeviceSession.h"
#include <utility>

namespace physvib {

struct DeviceSession::Opening {
    DeviceRequest request;
    AudioDrivers drivers;
    FoundDevice found{};
    std::string error{};
    bool isMissing = false;

    void open();
    std::string openFound();
};

std::string DeviceRequest::errorFor(AudioDevice& device) const {
    const int available = device.outputs();
    if (highestListeningOutput >= available)
        return name + ": has " + std::to_string(available) +
               " outputs; expected one of them to listen to or for marks, found output " +
               std::to_string(highestListeningOutput + 1);
    if (inputs.empty()) return {};
    const int highest = *inputs.rbegin(), count = device.inputs();
    return highest < count ? ""
                           : name + ": has " + std::to_string(count) +
                                 " inputs; expected one of them, found input " + std::to_string(highest + 1);
}

void DeviceSession::Opening::open() {
    found = findAudioDevice(drivers, request.name, !request.inputs.empty());
    error = found.device ? openFound()
                         : request.name + ": no such device (see physvib devices); nothing else is played on";
    if (error.empty()) return;
    isMissing = isMissing || !found.device;
    found.device.reset(); // before its driver
    found.driver.reset();
}

std::string DeviceSession::Opening::openFound() {
    auto& device = *found.device;
    if (auto missing = request.errorFor(device); !missing.empty()) return missing;
    const int available = device.outputs();
    ChannelSet outputs = request.outputs;
    outputs.erase(outputs.lower_bound(available), outputs.end());
    for (int k = 0; request.opensAll && k < available; ++k) outputs.insert(k);
    isMissing = outputs.empty();
    if (isMissing) return request.name + ": has none of the outputs that are wanted";
    const auto openError = device.open(request.inputs, outputs, request.sampleRateHz, request.blockFrames);
    return openError.empty() ? "" : request.name + ": " + openError;
}

DeviceSession::DeviceSession(AudioDrivers drivers, const std::atomic<bool>* cancel)
    : drivers_{std::move(drivers)}
    , cancel_{cancel} {}

DeviceSession::~DeviceSession() {
    if (found_.device || opening_) close();
}

std::string DeviceSession::open(const DeviceRequest& request, TimeLimit limit) {
    const auto deadline = hasTimedOut_ ? Clock::time_point{} : Clock::now() + limit; // after a time-out,
                                                                                     // later calls do not
                                                                                     // wait
    hasTimedOut_ = true;
    isMissing_ = false;
    const std::string timeOutError = request.name + ": its driver does not answer; nothing else is played on";
    if (!awaitIdle(deadline, cancel_)) {
        if (busyDevice_ == request.name) return timeOutError;
        thread_.abandon(); // another device may have a driver that answers
        opening_.reset();
        closingDevice_.reset();
    }
    if (opening_ && opening_->request != request) closeOnThread(std::exchange(opening_, nullptr)->found);
    if (!opening_ && awaitIdle(Clock::now() + limit, cancel_)) {
        opening_ = std::make_shared<Opening>(Opening{request, drivers_});
        busyDevice_ = request.name;
        thread_.begin([opening = opening_] { opening->open(); });
    }
    if (!opening_ || !awaitIdle(Clock::now() + limit, cancel_)) return timeOutError;
    hasTimedOut_ = false;
    const auto opened = std::exchange(opening_, nullptr);
    found_ = std::move(opened->found);
    isMissing_ = opened->isMissing;
    return opened->error;
}

void DeviceSession::start(AudioDeviceCallback& owner) {
    callback_ = std::make_shared<DetachableCallback>(owner);
    found_.device->start(*callback_);
}

void DeviceSession::restart() {
    found_.device->stop();
    found_.device->start(*callback_);
}

void DeviceSession::detach() noexcept {
    if (callback_) callback_->detach();
}

void DeviceSession::awaitBlock() const noexcept {
    if (callback_) callback_->awaitBlock();
}

void DeviceSession::close(TimeLimit limit) {
    detach();
    if (opening_ && awaitIdle({}, nullptr))
        found_ = std::move(std::exchange(opening_, nullptr)->found); // opened after the time limit
    closeOnThread(found_);
    awaitIdle(Clock::now() + limit, nullptr);
}

void DeviceSession::closeOnThread(FoundDevice& found) {
    if (!found.device) return;
    busyDevice_ = found.fullName();
    closingDevice_ = std::make_shared<FoundDevice>(std::move(found));
    thread_.begin([closed = closingDevice_, callback = std::exchange(callback_, nullptr)] {
        closed->device->stop();
        closed->device->close();
    });
}

// Devices are destroyed while M waits, because a driver may receive notifications on the message loop.
bool DeviceSession::awaitIdle(Clock::time_point deadline, const std::atomic<bool>* cancel) {
    if (!thread_.awaitEnd(deadline, cancel)) return false;
    if (!closingDevice_) return true;
    thread_.begin([closed = std::exchange(closingDevice_, nullptr)] {
        closed->device.reset(); // before its driver
        closed->driver.reset();
    });
    return thread_.awaitEnd(deadline, cancel);
}

} // namespace physvib
