// SPDX-License-Identifier: MIT
// Thread that finds a controller, follows the device's clock and sends the motor commands that are due.
#include "Live/Pads/PadOutput.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/DevicePulse.h"
#include <algorithm>
#include <chrono>

namespace physvib {
namespace {

constexpr std::chrono::milliseconds pause{1};
constexpr std::int64_t msNs = 1'000'000;
constexpr std::int64_t repeatNs = 100 * msNs;    // half the duration of a command
constexpr std::int64_t lookNs = 250 * msNs;      // search interval for a newly connected controller
constexpr std::int64_t patienceNs = 2000 * msNs; // a Bluetooth controller needs a second to connect
constexpr std::int64_t jumpNs = 70 * msNs; // a backward jump of session time that means a pause or a restart

std::string milliseconds(double seconds) { return fixedNumber(1e3 * seconds, 0) + " ms"; }

} // namespace

PadOutput::PadOutput(const std::string& where, const PhantomPanner& panner)
    : name_{where.substr(0, where.find('@'))}
    , first_{panner}
    , grips_{PadMotors::gripsOf(panner)} {
    if (name_.empty()) name_ = anyPad;
    if (const auto at = where.find('@'); at != where.npos) {
        auto profile = findPad(where.substr(at + 1));
        fault_ = profile.error;
        isProfileGiven_ = true;
        profile_ = std::move(profile.value);
    } else {
        profile_ = builtInPads().front();
    }
    leadSeconds_ = profile_.law.leadSeconds;
    if (fault_.empty()) thread_ = std::thread{[this] { run(); }};
}

PadOutput::~PadOutput() {
    follow(nullptr);
    stop_ = true;
    if (thread_.joinable()) thread_.join();
}

std::string PadOutput::awaitReady(const std::function<bool()>& keepGoing) {
    const std::int64_t endNs = steadyNs() + patienceNs;
    for (;;) {
        {
            const std::lock_guard lock{mutex_};
            if (!fault_.empty()) return fault_;
            if (pad_) return {};
            if (!keepGoing() || steadyNs() > endNs) return troubleNow();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds{5});
    }
}

void PadOutput::follow(OutputClock* device) {
    const std::lock_guard lock{mutex_};
    if (device == device_) return;
    rest();
    device_ = device;
    for (CollisionEvent event; device && events_.pop(event);) {
    } // events of an earlier session
    for (RenderControl control; device && controls_.pop(control);) controls_.done(control);
    grips_ = PadMotors::gripsOf(first_);
    clock_ = {};
    begin();
}

void PadOutput::begin() {
    PadLaw law = profile_.law;
    if (pad_)
        law.commandsPerSecond = std::min(law.commandsPerSecond, mostCommandsPerSecond(pad_->info().bus));
    motors_ = PadMotors{law};
    layouts_.clear();
    stopsNs_.clear();
    playedNs_ = 0;
}

void PadOutput::rest() {
    if (pad_ && !sent_.isSame({})) pad_->rumble(0.0, 0.0);
    sent_ = {};
}

void PadOutput::run() {
    GamePads pads;
    while (!stop_) {
        {
            const std::lock_guard lock{mutex_};
            if (!pads.fault().empty()) {
                fault_ = pads.fault();
                return;
            }
            pads.update();
            connect(pads);
            feed(steadyNs());
        }
        std::this_thread::sleep_for(pause);
    }
    const std::lock_guard lock{mutex_};
    rest();
    pad_.reset();
}

void PadOutput::connect(GamePads& pads) {
    if (pad_ && pad_->isAttached()) return;
    pad_.reset();
    const std::int64_t nowNs = steadyNs();
    if (nowNs < looksNs_) return;
    looksNs_ = nowNs + lookNs;
    if (auto pad = pads.open(lastName_.empty() ? name_ : lastName_))
        adopt(std::move(pad));
    else if (auto other = lastName_.empty() ? nullptr : pads.open(name_))
        adopt(std::move(other));
}

void PadOutput::adopt(std::unique_ptr<GamePad> pad) {
    pad_ = std::move(pad);
    lastName_ = pad_->info().name;
    sent_ = {};
    ++counts_.connections;
    if (!isProfileGiven_)
        if (auto suits = findPad(pad_->info().profile)) profile_ = std::move(suits.value);
    if (counts_.connections == 1) leadSeconds_ = profile_.law.leadSeconds; // output latency: never changes
    begin();
}

void PadOutput::feed(std::int64_t nowNs) {
    if (device_ == nullptr) return;
    if (const OutputMoment felt = device_->felt(); felt.steadyNs != 0) clock_.add(felt);
    if (!clock_.isReady()) return;
    const std::int64_t sessionNs = nowNs - clock_.steadyAt(0);
    if (sessionNs + jumpNs < playedNs_) begin();
    playedNs_ = sessionNs;
    takeControls(sessionNs);
    takeEvents();
    command(sessionNs, nowNs);
}

// A layout applies from the first event at its time, a stop from the time at which it is felt.
void PadOutput::takeControls(std::int64_t sessionNs) {
    for (RenderControl control; controls_.pop(control); controls_.done(control)) {
        if (control.panner != nullptr)
            layouts_.push_back({control.timeNs, PadMotors::gripsOf(*control.panner)});
        if (control.kind == RenderControl::Kind::stopAll) stopsNs_.push_back(control.timeNs);
    }
    for (; !stopsNs_.empty() && stopsNs_.front() <= sessionNs; stopsNs_.erase(stopsNs_.begin()))
        motors_.stop(stopsNs_.front());
}

void PadOutput::takeEvents() {
    for (CollisionEvent event; events_.pop(event);) {
        for (; !layouts_.empty() && layouts_.front().timeNs <= event.timeNs; layouts_.erase(layouts_.begin()))
            grips_ = layouts_.front().panner;
        motors_.strike(event, grips_);
        ++counts_.events;
    }
}

void PadOutput::command(std::int64_t sessionNs, std::int64_t nowNs) {
    const double level = device_->isSilent() ? 0.0 : static_cast<double>(device_->level());
    if (level <= 0.0) rest(); // at once, regardless of the command rate
    PadCommand newest = sent_;
    int due = 0;
    for (; motors_.dueNs() <= sessionNs; ++due) newest = motors_.next(level);
    if (due > 1) counts_.late += static_cast<std::uint64_t>(due - 1);
    if (!pad_) return;
    const bool isNew = !newest.isSame(sent_);
    if (isNew)
        send(newest, nowNs), ++counts_.commands;
    else if (!sent_.isSame({}) && nowNs - sentNs_ >= repeatNs)
        send(sent_, nowNs), ++counts_.repeats;
}

void PadOutput::send(const PadCommand& command, std::int64_t nowNs) {
    if (!pad_->rumble(command.low, command.high)) ++counts_.refused;
    sent_ = command;
    sentNs_ = nowNs;
}

std::string PadOutput::troubleNow() const {
    if (!fault_.empty()) return fault_;
    if (pad_) return {};
    if (!lastName_.empty()) return lastName_ + " is gone; it is looked for";
    return name_ == anyPad
               ? "no game controller with motors is there (see physvib pads)"
               : "no game controller with motors is called " + inQuotes(name_) + " (see physvib pads)";
}

PadCounts PadOutput::counts() const {
    const std::lock_guard lock{mutex_};
    return counts_;
}

SinkState PadOutput::state() const {
    const std::lock_guard lock{mutex_};
    SinkState state;
    state.name = "controller";
    state.isReady = pad_ != nullptr;
    state.sent = counts_.events;
    state.playsClips = false;
    state.lost = motors_.lost() + events_.overflows() + controls_.overflows();
    state.trouble = troubleNow();
    state.where = pad_ ? pad_->info().name + " (" + busName(pad_->info().bus) + "): " + profile_.name +
                             ", needs " + milliseconds(leadSeconds_)
                       : state.trouble;
    state.facts = {
        {"Controller", state.where, !state.isReady},
        {"Motors",
         std::to_string(counts_.commands) + " commands, " + std::to_string(counts_.refused) + " refused",
         counts_.refused > 0}};
    return state;
}

std::string PadOutput::summary(const std::function<bool()>&) const {
    const std::lock_guard lock{mutex_};
    const PadMotor& slow =
        profile_.law.low.riseSeconds > profile_.law.high.riseSeconds ? profile_.law.low : profile_.law.high;
    std::string line = (lastName_.empty() ? name_ : lastName_) + ": " + std::to_string(counts_.events) +
                       " events as " + profile_.name + ", " + std::to_string(counts_.commands) +
                       " commands, " + std::to_string(counts_.repeats) + " repeated, " +
                       std::to_string(counts_.late) + " overtaken, " + std::to_string(counts_.refused) +
                       " refused, " + std::to_string(motors_.lost() + events_.overflows()) + " events lost; ";
    line += "began " + milliseconds(leadSeconds_) + " before the device, motors take " +
            milliseconds(slow.riseSeconds);
    if (counts_.connections > 1) line += "; plugged in " + std::to_string(counts_.connections) + " times";
    return line + "\n";
}

} // namespace physvib
