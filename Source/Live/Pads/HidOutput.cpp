// SPDX-License-Identifier: MIT
// Thread that looks for a controller, follows the device's clock and writes the reports that are due.
#include "Live/Pads/HidOutput.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/DevicePulse.h"
#include <chrono>

namespace physvib {
namespace {

constexpr std::int64_t msNs = 1'000'000;
constexpr std::int64_t lookNs = 250 * msNs; // search interval for a newly connected controller
constexpr std::int64_t jumpNs = 70 * msNs;  // session time that goes back so far means a pause or a restart
constexpr std::int64_t patienceNs = 500 * msNs;

} // namespace

HidOutput::HidOutput(const std::string& where, std::unique_ptr<HidFeed> feed)
    : where_{where.empty() ? anyPad : where}
    , feed_{std::move(feed)}
    , thread_{[this] { run(); }} {}

HidOutput::~HidOutput() {
    follow(nullptr);
    stop_ = true;
    thread_.join();
}

std::string HidOutput::awaitReady(const std::function<bool()>& keepGoing) {
    const std::int64_t endNs = steadyNs() + patienceNs;
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds{5})) {
        const std::lock_guard lock{mutex_};
        if (pad_) return {};
        if (!keepGoing() || steadyNs() > endNs) return troubleNow();
    }
}

void HidOutput::follow(OutputClock* device) {
    const std::lock_guard lock{mutex_};
    if (device == device_) return;
    rest();
    device_ = device;
    clock_ = {};
    playedNs_ = 0;
    feed_->begin();
}

void HidOutput::run() {
    while (!stop_) {
        {
            const std::lock_guard lock{mutex_};
            connect();
            feedPad(steadyNs());
        }
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    const std::lock_guard lock{mutex_};
    rest();
    pad_.reset();
}

void HidOutput::connect() {
    const std::int64_t nowNs = steadyNs();
    if (pad_ || nowNs < looksNs_) return;
    looksNs_ = nowNs + lookNs;
    auto found = HidDevice::open(feed_->kind().models, where_);
    refusal_ = found.error;
    if (!found) return;
    pad_ = std::move(found.value);
    lastName_ = pad_->place().name;
    hasSent_ = false;
    ++counts_.connections;
}

void HidOutput::feedPad(std::int64_t nowNs) {
    if (device_ == nullptr) return;
    if (const OutputMoment felt = device_->felt(); felt.steadyNs != 0) clock_.add(felt);
    if (!clock_.isReady()) return;
    const std::int64_t sessionNs = nowNs - clock_.steadyAt(0);
    if (sessionNs + jumpNs < playedNs_) feed_->begin();
    playedNs_ = sessionNs;
    const auto report = feed_->next(nowNs, sessionNs, device_->isSilent() ? 0.0f : device_->level());
    if (!report || !pad_) return;
    if (!hasSent_) sendAll(feed_->on());
    hasSent_ = true;
    if (send(*report)) ++counts_.reports;
}

bool HidOutput::send(const PadReport& report) {
    if (pad_ && !pad_->write(report.span())) pad_.reset();
    return pad_ != nullptr;
}

void HidOutput::sendAll(std::span<const PadReport> reports) {
    for (const PadReport& report : reports) {
        send(report);
        std::this_thread::sleep_for(std::chrono::duration<double>{switchSeconds});
    }
}

void HidOutput::rest() {
    if (!pad_ || !hasSent_) return;
    send(feed_->rest());
    sendAll(feed_->off());
    hasSent_ = false;
}

std::string HidOutput::troubleNow() const {
    if (pad_) return {};
    if (!lastName_.empty()) return lastName_ + " is gone; it is looked for";
    if (refusal_ == "none is there")
        return where_ == anyPad ? "no " + label() + " is there"
                                : "no " + label() + " is called " + inQuotes(where_);
    return refusal_;
}

HidCounts HidOutput::counts() const {
    const std::lock_guard lock{mutex_};
    return counts_;
}

SinkState HidOutput::state() const {
    const std::lock_guard lock{mutex_};
    SinkState state;
    state.name = "controller";
    state.isReady = pad_ != nullptr;
    state.sent = counts_.reports;
    state.lost = feed_->lost();
    state.playsClips = feed_->playsClips();
    state.trouble = troubleNow();
    state.where = pad_ ? label() + ", " + pad_->place().node.string() + ": up to " +
                             fixedNumber(1e3 * feed_->laterSeconds(), 0) + " ms after the device"
                       : state.trouble;
    state.facts = {{"Controller", state.where, !state.isReady},
                   {"Reports", std::to_string(counts_.reports), false}};
    return state;
}

std::string HidOutput::summary(const std::function<bool()>&) const {
    const std::lock_guard lock{mutex_};
    std::string line = (lastName_.empty() ? label() : lastName_) + ": " + std::to_string(counts_.reports) +
                       " reports, " + std::to_string(feed_->lost()) + " lost";
    if (counts_.connections > 1) line += "; connected " + std::to_string(counts_.connections) + " times";
    return line + "\n";
}

} // namespace physvib
