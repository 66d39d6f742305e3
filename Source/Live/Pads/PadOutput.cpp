// SPDX-License-Identifier: MIT
// Thread that finds a controller, follows the device's clock and sends the motor commands that are due.
#include "Live/Pads/PadOutput.h"
#include "Io/Text/NumberText.h"

namespace physvib {
namespace {

constexpr std::int64_t msNs = 1'000'000;
constexpr std::int64_t repeatNs = 100 * msNs;         // half the duration of a command
constexpr std::int64_t searchIntervalNs = 250 * msNs; // search interval for a newly connected controller
constexpr std::int64_t timeOutNs = 2000 * msNs;       // a Bluetooth controller needs a second to connect

std::string milliseconds(double seconds) { return fixedNumber(1e3 * seconds, 0) + " ms"; }

} // namespace

PadOutput::PadOutput(const std::string& name, const PhantomPanner& panner)
    : nameFilter_{name.substr(0, name.find('@'))}
    , gripPanner_{PadMotors::makeGripPanner(panner)} {
    if (nameFilter_.empty()) nameFilter_ = anyPad;
    if (const auto separator = name.find('@'); separator != name.npos) {
        auto profile = findPad(name.substr(separator + 1));
        error_ = profile.error;
        hasRequestedProfile_ = true;
        profile_ = std::move(profile.value);
    } else {
        profile_ = builtInPads().front();
    }
    if (error_.empty()) thread_ = std::thread{[this] { run(); }};
}

PadOutput::~PadOutput() {
    follow(nullptr);
    isStopping_ = true;
    if (thread_.joinable()) thread_.join();
}

std::string PadOutput::awaitReady(const std::function<bool()>& keepGoing) {
    return device_.await(
        timeOutNs, keepGoing, [this] { return connectedPad_ || !error_.empty(); },
        [this] { return currentError(); });
}

void PadOutput::follow(OutputClock* device) {
    const auto change = [&] {
        for (CollisionEvent event; device && events_.pop(event);) {
        } // events of an earlier session
        for (RenderControl control; device && controls_.pop(control); controls_.done(control))
            if (control.panner != nullptr) gripPanner_ = PadMotors::makeGripPanner(*control.panner);
    };
    device_.follow(device, change, [this] { return !error_.empty(); });
}

void PadOutput::begin() {
    PadModel law = profile_.law;
    if (connectedPad_)
        law.commandsPerSecond = std::min(law.commandsPerSecond, maxCommandsPerSecond(connectedPad_->bus));
    motors_ = PadMotors{law};
    if (!pendingPanners_.empty()) gripPanner_ = pendingPanners_.back().panner; // the session goes on with it
    pendingPanners_.clear();
    stopsNs_.clear();
    latestCommand_ = {};
    strongestUntilNs_ = 0;
}

void PadOutput::run() {
    GamePads pads;
    if (!pads.error().empty()) {
        const std::lock_guard lock{device_.mutex};
        error_ = pads.error();
        return;
    }
    for (; !isStopping_; std::this_thread::sleep_for(std::chrono::milliseconds{1})) {
        pads.update();
        connect(pads);
        device_.restartIfChanged([this] { send({}); }, [this] { begin(); });
        if (const auto command = dueCommand(steadyNs())) send(*command);
    }
    send({});
    pad_.reset();
}

void PadOutput::connect(GamePads& pads) {
    if (pad_ ? pad_->isAttached() : steadyNs() < nextSearchNs_) return;
    nextSearchNs_ = steadyNs() + searchIntervalNs;
    pad_.reset();                                                  // close it before it is opened again
    pad_ = pads.open(lastName_.empty() ? nameFilter_ : lastName_); // this thread alone sets that
    if (!pad_ && !lastName_.empty()) pad_ = pads.open(nameFilter_);
    const std::lock_guard lock{device_.mutex};
    connectedPad_.reset();
    if (!pad_) return;
    connectedPad_ = pad_->info();
    lastName_ = connectedPad_->name;
    sentCommand_ = {};
    ++counts_.connections;
    if (!hasRequestedProfile_)
        if (auto builtIn = findPad(connectedPad_->profile)) profile_ = std::move(builtIn.value);
    if (counts_.connections == 1) leadSeconds_ = profile_.law.leadSeconds; // it stays, plugged in or not
    begin();
}

std::optional<PadCommand> PadOutput::dueCommand(std::int64_t nowNs) {
    const std::lock_guard lock{device_.mutex};
    const auto sessionNs = device_.sessionNs(nowNs, [this] { begin(); });
    if (!sessionNs) return {};
    processControls(*sessionNs);
    processEvents();
    return nextCommand(*sessionNs, nowNs);
}

// A layout applies from the first event at its time, a stop from the time at which it is felt.
void PadOutput::processControls(std::int64_t sessionNs) {
    for (RenderControl control; controls_.pop(control); controls_.done(control)) {
        if (control.panner != nullptr)
            pendingPanners_.push_back({control.timeNs, PadMotors::makeGripPanner(*control.panner)});
        if (control.kind == RenderControl::Kind::stopAll) stopsNs_.push_back(control.timeNs);
    }
    for (; !stopsNs_.empty() && stopsNs_.front() <= sessionNs; stopsNs_.erase(stopsNs_.begin()))
        motors_.stop(stopsNs_.front()), strongestUntilNs_ = 0;
}

void PadOutput::processEvents() {
    for (CollisionEvent event; events_.pop(event);) {
        for (; !pendingPanners_.empty() && pendingPanners_.front().timeNs <= event.timeNs;
             pendingPanners_.erase(pendingPanners_.begin()))
            gripPanner_ = pendingPanners_.front().panner;
        motors_.strike(event, gripPanner_);
        ++counts_.events;
    }
}

std::optional<PadCommand> PadOutput::nextCommand(std::int64_t sessionNs, std::int64_t nowNs) {
    const double level = static_cast<double>(device_.level());
    if (level <= 0.0) latestCommand_ = {}, strongestUntilNs_ = 0; // silence: at once, at any command rate
    PadCommand newest = nowNs < strongestUntilNs_ ? sentCommand_ : latestCommand_;
    if (const auto batch = motors_.nextUntil(sessionNs, level); batch.count > 0) { // several after a wait
        counts_.late += static_cast<std::uint64_t>(batch.count - 1);
        newest = batch.strongest, latestCommand_ = batch.last;
        strongestUntilNs_ = newest.isSame(latestCommand_) ? 0 : nowNs + motors_.intervalNs();
    }
    if (!pad_) return {};
    if (!newest.isSame(sentCommand_)) return ++counts_.commands, newest;
    if (sentCommand_.isSame({}) || nowNs - sentNs_ < repeatNs) return {};
    return ++counts_.repeats, newest;
}

void PadOutput::send(const PadCommand& command) {
    if (!pad_ || (command.isSame({}) && sentCommand_.isSame({}))) return;
    sentCommand_ = command;
    sentNs_ = steadyNs();
    if (pad_->rumble(command.low, command.high)) return;
    const std::lock_guard lock{device_.mutex};
    ++counts_.refused;
}

std::string PadOutput::currentError() const {
    if (!error_.empty()) return error_;
    if (connectedPad_) return {};
    if (!lastName_.empty()) return lastName_ + " is gone; it is looked for";
    return nameFilter_ == anyPad ? "no game controller with motors is there: plug it in, or switch it on"
                                 : "no game controller with motors is called " + inQuotes(nameFilter_) +
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
    state.isReady = connectedPad_.has_value();
    state.sent = counts_.events;
    state.playsClips = false;
    state.lost = motors_.lost() + events_.overflows() + controls_.overflows();
    state.error = currentError();
    state.label = connectedPad_ ? connectedPad_->name + " (" + busName(connectedPad_->bus) +
                                      "): " + profile_.name + ", needs " + milliseconds(leadSeconds_)
                                : state.error;
    state.details = {
        {"Controller", state.label, !state.isReady},
        {"Motors",
         std::to_string(counts_.commands) + " commands, " + std::to_string(counts_.refused) + " refused",
         counts_.refused > 0}};
    return state;
}

std::string PadOutput::summary(const std::function<bool()>&) const {
    const std::lock_guard lock{device_.mutex};
    const PadMotor& slower =
        profile_.law.low.riseSeconds > profile_.law.high.riseSeconds ? profile_.law.low : profile_.law.high;
    std::string line = (lastName_.empty() ? nameFilter_ : lastName_) + ": " + std::to_string(counts_.events) +
                       " events as " + profile_.name + ", " + std::to_string(counts_.commands) +
                       " commands, " + std::to_string(counts_.repeats) + " repeated, " +
                       std::to_string(counts_.late) + " overtaken, " + std::to_string(counts_.refused) +
                       " refused, " + std::to_string(motors_.lost() + events_.overflows()) + " events lost; ";
    line += "began " + milliseconds(leadSeconds_) + " before the device, motors take " +
            milliseconds(slower.riseSeconds);
    if (counts_.connections > 1) line += "; plugged in " + std::to_string(counts_.connections) + " times";
    return line + "\n";
}

} // namespace physvib
