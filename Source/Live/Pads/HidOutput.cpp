// SPDX-License-Identifier: MIT
// Thread that looks for a controller, follows the device's clock and writes the reports that are due.
#include "Live/Pads/HidOutput.h"
#include "Io/Text/NumberText.h"
#include <chrono>

namespace physvib {
namespace {

constexpr std::int64_t msNs = 1'000'000;
constexpr std::int64_t lookNs = 250 * msNs; // search interval for a newly connected controller
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
    return device_.await(
        patienceNs, keepGoing, [this] { return !node_.empty(); }, [this] { return troubleNow(); });
}

void HidOutput::follow(OutputClock* device) {
    device_.follow(
        device, [] {}, [] { return false; }); // the first report of silence is written within 20 ms
}

void HidOutput::run() {
    for (; !stop_; std::this_thread::sleep_for(std::chrono::milliseconds{1})) {
        connect();
        device_.beginAnew([this] { rest(); }, [this] { feed_->begin(); });
        if (const auto report = due(steadyNs())) write(*report);
    }
    rest();
}

void HidOutput::connect() {
    const std::int64_t nowNs = steadyNs();
    if (pad_ || nowNs < looksNs_) return;
    looksNs_ = nowNs + lookNs;
    auto found = HidDevice::open(feed_->kind().models, where_);
    const std::lock_guard lock{device_.mutex};
    refusal_ = found.error;
    if (!found) return;
    pad_ = std::move(found.value);
    hasSent_ = false;
    node_ = pad_->place().node.string();
    lastName_ = pad_->place().name;
    leadSeconds_ = feed_->leadSeconds();
    ++counts_.connections;
}

std::optional<PadReport> HidOutput::due(std::int64_t nowNs) {
    const std::lock_guard lock{device_.mutex};
    const auto sessionNs = device_.sessionNs(nowNs, [this] { feed_->begin(); });
    return sessionNs ? feed_->next(nowNs, *sessionNs, device_.level()) : std::nullopt;
}

void HidOutput::write(const PadReport& report) {
    if (!pad_) return;
    if (!hasSent_) sendAll(feed_->on());
    hasSent_ = true;
    if (!send(report)) return;
    const std::lock_guard lock{device_.mutex};
    ++counts_.reports;
}

bool HidOutput::send(const PadReport& report) {
    if (pad_ && !pad_->write(report.span())) {
        pad_.reset();
        const std::lock_guard lock{device_.mutex};
        node_.clear();
    }
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
    for (int i = 0; i < silentReports && send(feed_->rest()); ++i)
        std::this_thread::sleep_for(std::chrono::duration<double>{switchSeconds});
    sendAll(feed_->off());
    hasSent_ = false;
}

std::string HidOutput::troubleNow() const {
    if (!node_.empty()) return {};
    if (!lastName_.empty()) return lastName_ + " is gone; it is looked for";
    if (refusal_ == "none is there")
        return where_ == anyPad ? "no " + label() + " is there"
                                : "no " + label() + " is called " + inQuotes(where_);
    return refusal_;
}

HidCounts HidOutput::counts() const {
    const std::lock_guard lock{device_.mutex};
    return counts_;
}

SinkState HidOutput::state() const {
    const std::lock_guard lock{device_.mutex};
    SinkState state;
    state.name = "controller";
    state.isReady = !node_.empty();
    state.sent = counts_.reports;
    state.lost = feed_->lost();
    state.playsClips = feed_->playsClips();
    state.trouble = troubleNow();
    state.where = state.isReady ? label() + ", " + node_ + ": up to " +
                                      fixedNumber(1e3 * feed_->laterSeconds(), 0) + " ms after the device"
                                : state.trouble;
    state.facts = {{"Controller", state.where, !state.isReady},
                   {"Reports", std::to_string(counts_.reports), false}};
    return state;
}

std::string HidOutput::summary(const std::function<bool()>&) const {
    const std::lock_guard lock{device_.mutex};
    std::string line = (lastName_.empty() ? label() : lastName_) + ": " + std::to_string(counts_.reports) +
                       " reports, " + std::to_string(feed_->lost()) + " lost";
    if (counts_.connections > 1) line += "; connected " + std::to_string(counts_.connections) + " times";
    return line + "\n";
}

} // namespace physvib
