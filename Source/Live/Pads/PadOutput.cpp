// SPDX-License-Identifier: MIT
// Thread that finds a controller, follows the device's clock and sends the motor commands that are due.
#include "Live/Pads/PadOutput.h"
#include "Io/Text/NumberText.h"

namespace physvib {
namespace {

constexpr std::int64_t msNs = 1'000'000;
constexpr std::int64_t repeatNs = 100 * msNs;    // half the duration of a command
constexpr std::int64_t lookNs = 250 * msNs;      // search interval for a newly connected controller
constexpr std::int64_t patienceNs = 2000 * msNs; // a Bluetooth controller needs a second to connect

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
    if (fault_.empty()) thread_ = std::thread{[this] { run(); }};
}

PadOutput::~PadOutput() {
    follow(nullptr);
    stop_ = true;
    if (thread_.joinable()) thread_.join();
}

std::string PadOutput::awaitReady(const std::function<bool()>& keepGoing) {
    return device_.await(
        patienceNs, keepGoing, [this] { return there_ || !fault_.empty(); }, [this] { return troubleNow(); });
}

void PadOutput::follow(OutputClock* device) {
    const auto change = [&] {
        for (CollisionEvent event; device && events_.pop(event);) {
        } // events of an earlier session
        for (RenderControl control; device && controls_.pop(control);) controls_.done(control);
        grips_ = PadMotors::gripsOf(first_);
    };
    device_.follow(device, change, [this] { return !fault_.empty(); });
}

void PadOutput::begin() {
    PadLaw law = profile_.law;
    if (there_) law.commandsPerSecond = std::min(law.commandsPerSecond, mostCommandsPerSecond(there_->bus));
    motors_ = PadMotors{law};
    layouts_.clear();
    stopsNs_.clear();
    wanted_ = {};
    holdsUntilNs_ = 0;
}

void PadOutput::run() {
    GamePads pads;
    if (!pads.fault().empty()) {
        const std::lock_guard lock{device_.mutex};
        fault_ = pads.fault();
        return;
    }
    for (; !stop_; std::this_thread::sleep_for(std::chrono::milliseconds{1})) {
        pads.update();
        connect(pads);
        device_.beginAnew([this] { send({}); }, [this] { begin(); });
        if (const auto command = due(steadyNs())) send(*command);
    }
    send({});
    pad_.reset();
}

void PadOutput::connect(GamePads& pads) {
    if (pad_ ? pad_->isAttached() : steadyNs() < looksNs_) return;
    looksNs_ = steadyNs() + lookNs;
    pad_.reset();                                            // close it before it is opened again
    pad_ = pads.open(lastName_.empty() ? name_ : lastName_); // this thread alone sets that
    if (!pad_ && !lastName_.empty()) pad_ = pads.open(name_);
    const std::lock_guard lock{device_.mutex};
    there_.reset();
    if (!pad_) return;
    there_ = pad_->info();
    lastName_ = there_->name;
    sent_ = {};
    ++counts_.connections;
    if (!isProfileGiven_)
        if (auto suits = findPad(there_->profile)) profile_ = std::move(suits.value);
    if (counts_.connections == 1) leadSeconds_ = profile_.law.leadSeconds; // it stays, plugged in or not
    begin();
}

std::optional<PadCommand> PadOutput::due(std::int64_t nowNs) {
    const std::lock_guard lock{device_.mutex};
    const auto sessionNs = device_.sessionNs(nowNs, [this] { begin(); });
    if (!sessionNs) return {};
    takeControls(*sessionNs);
    takeEvents();
    return command(*sessionNs, nowNs);
}

// A layout applies from the first event at its time, a stop from the time at which it is felt.
void PadOutput::takeControls(std::int64_t sessionNs) {
    for (RenderControl control; controls_.pop(control); controls_.done(control)) {
        if (control.panner != nullptr)
            layouts_.push_back({control.timeNs, PadMotors::gripsOf(*control.panner)});
        if (control.kind == RenderControl::Kind::stopAll) stopsNs_.push_back(control.timeNs);
    }
    for (; !stopsNs_.empty() && stopsNs_.front() <= sessionNs; stopsNs_.erase(stopsNs_.begin()))
        motors_.stop(stopsNs_.front()), holdsUntilNs_ = 0;
}

void PadOutput::takeEvents() {
    for (CollisionEvent event; events_.pop(event);) {
        for (; !layouts_.empty() && layouts_.front().timeNs <= event.timeNs; layouts_.erase(layouts_.begin()))
            grips_ = layouts_.front().panner;
        motors_.strike(event, grips_);
        ++counts_.events;
    }
}

std::optional<PadCommand> PadOutput::command(std::int64_t sessionNs, std::int64_t nowNs) {
    const double level = static_cast<double>(device_.level());
    if (level <= 0.0) wanted_ = {}, holdsUntilNs_ = 0; // silence: at once, at any command rate
    PadCommand newest = nowNs < holdsUntilNs_ ? sent_ : wanted_;
    if (const auto due = motors_.nextUntil(sessionNs, level); due.count > 0) { // several, if a call was held
        counts_.late += static_cast<std::uint64_t>(due.count - 1);
        newest = due.strongest, wanted_ = due.last;
        holdsUntilNs_ = newest.isSame(wanted_) ? 0 : nowNs + motors_.intervalNs();
    }
    if (!pad_) return {};
    if (!newest.isSame(sent_)) return ++counts_.commands, newest;
    if (sent_.isSame({}) || nowNs - sentNs_ < repeatNs) return {};
    return ++counts_.repeats, newest;
}

void PadOutput::send(const PadCommand& command) {
    if (!pad_ || (command.isSame({}) && sent_.isSame({}))) return;
    sent_ = command;
    sentNs_ = steadyNs();
    if (pad_->rumble(command.low, command.high)) return;
    const std::lock_guard lock{device_.mutex};
    ++counts_.refused;
}

std::string PadOutput::troubleNow() const {
    if (!fault_.empty()) return fault_;
    if (there_) return {};
    if (!lastName_.empty()) return lastName_ + " is gone; it is looked for";
    return name_ == anyPad ? "no game controller with motors is there: plug it in, or switch it on"
                           : "no game controller with motors is called " + inQuotes(name_) +
                                 ": plug it in, or choose another";
}

PadCounts PadOutput::counts() const {
    const std::lock_guard lock{device_.mutex};
    return counts_;
}

SinkState PadOutput::state() const {
    const std::lock_guard lock{device_.mutex};
    SinkState state;
    state.name = "controller";
    state.isReady = there_.has_value();
    state.sent = counts_.events;
    state.playsClips = false;
    state.lost = motors_.lost() + events_.overflows() + controls_.overflows();
    state.trouble = troubleNow();
    state.where = there_ ? there_->name + " (" + busName(there_->bus) + "): " + profile_.name + ", needs " +
                               milliseconds(leadSeconds_)
                         : state.trouble;
    state.facts = {
        {"Controller", state.where, !state.isReady},
        {"Motors",
         std::to_string(counts_.commands) + " commands, " + std::to_string(counts_.refused) + " refused",
         counts_.refused > 0}};
    return state;
}

std::string PadOutput::summary(const std::function<bool()>&) const {
    const std::lock_guard lock{device_.mutex};
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
