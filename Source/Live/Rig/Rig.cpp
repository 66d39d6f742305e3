// SPDX-License-Identifier: MIT
// Opens and closes the parts of a live rig in the order that their threads require.
#include "Live/Rig/Rig.h"

namespace physvib {

ThreadDriver::ThreadDriver(Session& session, int stepsPerSecond, const std::atomic<bool>* isEnded)
    : session_{session}
    , stepNs_{std::max(pollNs, std::int64_t{1'000'000'000} / stepsPerSecond)}
    , isEnded_{isEnded}
    , thread_{[this] { run(); }} {}

ThreadDriver::~ThreadDriver() {
    isDestroyed_ = true;
    thread_.join();
}

void ThreadDriver::run() {
    raiseThreadPriority(false);
    while (!isOver()) {
        const std::int64_t begin = steadyNs();
        // limited, so that a display of a world too slow for real time need not wait until it has caught up
        session_.advance([&](auto) { return steadyNs() - begin <= maxAdvanceNs && !isOver(); });
        const std::int64_t now = steadyNs(), untilStepNs = session_.world().nextStepNs() - now;
        std::int64_t sleepNs = std::max(untilStepNs, std::int64_t{0}) + pollNs; // then the block is rendered
        if (untilStepNs > maxBlockNs) sleepNs = 4 * pollNs; // the first block may come at any time
        if (session_.pulse().isPaused(now)) sleepNs = stepNs_;
        std::this_thread::sleep_for(std::chrono::nanoseconds{std::max(sleepNs, (now - begin) / 8)});
    }
}

namespace {

RigSettings withLog(RigSettings settings) {
    if (!settings.savePath.empty()) settings.setup.log = LogUse::stream;
    return settings;
}

} // namespace

Rig::Rig(RigSettings settings, AudioDrivers drivers, const std::atomic<bool>* isEnded)
    : settings_{withLog(std::move(settings))}
    , isEnded_{isEnded}
    , session_{settings_.setup}
    , inputs_{settings_.output.inputs.empty() ? nullptr : std::make_unique<InputTap>()}
    , output_{session_, std::move(drivers), isEnded} {
    settings_.output.tap = inputs_.get();
}

Rig::~Rig() { close(); }

std::string Rig::open() {
    if (auto error = connectSinks(); !error.empty()) return error;
    if (auto error = openDevice(settings_.output); !error.empty()) return error;
    if (auto error = beginRecording(); !error.empty()) return error;
    return beginJournal();
}

std::string Rig::connectSinks() {
    const auto keepGoing = [this] { return this->keepGoing(); };
    connectedAt_ = std::chrono::steady_clock::now();
    if (auto error = openSinks(settings_.sinks, settings_.setup.panner,
                               settings_.awaitsSinks ? std::function<bool()>{keepGoing} : nullptr, sinks_);
        !error.empty())
        return error;
    for (const auto& sink : sinks_) session_.sinks().attach(*sink);
    return {};
}

std::string Rig::openDevice(const AudioOutputSettings& output) { return deviceError_ = output_.open(output); }

std::string Rig::beginRecording() {
    if (settings_.recordPath.empty()) return {};
    recording_.emplace(settings_.recordPath, settings_.setup.channels, output_.sampleRateHz());
    if (auto error = recording_->error(); !error.empty()) return error;
    recording_->setOutputLatency(session_.timeline().outputLatencyFrames());
    session_.sinks().attach(*recording_);
    return {};
}

std::string Rig::beginJournal() {
    if (settings_.savePath.empty()) return {};
    journal_.emplace(settings_.savePath, session_, settings_.setup, settings_.provenance);
    return journal_->error();
}

void Rig::start() {
    session_.sinks().follow(&output_);
    if (settings_.hasOwnThread) driver_.emplace(session_, settings_.setup.stepsPerSecond, isEnded_);
}

void Rig::step() {
    if (!settings_.hasOwnThread && keepGoing()) session_.advance([this](auto) { return keepGoing(); });
}

std::string droppedEventsText(std::uint64_t events) {
    return events == 0 ? ""
                       : std::to_string(events) + (events == 1 ? " event was" : " events were") +
                             " lost, as no device ran";
}

void Rig::maintain() {
    deviceError_ = output_.maintain();
    const std::uint64_t dropped = session_.pulse().dropped();
    eventError_ = std::exchange(reportedDropped_, dropped) == dropped ? "" : droppedEventsText(dropped);
}

std::vector<SinkState> Rig::sinkStates() const {
    std::vector<SinkState> states;
    for (const auto& sink : sinks_) states.push_back(sink->state());
    return states;
}

std::vector<RigError> Rig::errors() const {
    std::vector<RigError> all;
    const auto add = [&all](const std::string& source, const std::string& text) {
        if (!text.empty()) all.push_back({source, text});
    };
    add("device", deviceError_);
    add("events", eventError_);
    const bool isStarting =
        !settings_.awaitsSinks && std::chrono::steady_clock::now() - connectedAt_ < sinkTimeOut;
    if (!isStarting)
        for (const SinkState& sink : sinkStates()) add(sink.name, sink.error);
    if (journal_) add("journal", journal_->currentError());
    if (recording_) add("recording", recording_->error());
    return all;
}

std::string Rig::errorText() const {
    std::string line;
    for (const RigError& error : errors()) line += (line.empty() ? "" : "; ") + error.text;
    return line;
}

std::string Rig::summary(std::string& sinkError) const {
    std::string lines;
    for (const auto& sink : sinks_) {
        lines += sink->summary([this] { return keepGoing(); });
        const SinkState state = sink->state();
        if (sinkError.empty() && !state.isReady)
            sinkError = state.error.empty() ? "the " + state.name + " is gone" : state.error;
    }
    return lines;
}

// The journal's pending lines come first, because the rest may take long or hang.
void Rig::endFiles() {
    if (journal_) journal_->end(session_.status().sessionNs);
    if (recording_) recordingError_ = recording_->finish();
}

std::string Rig::finish(bool isHurried) {
    std::string error;
    if (journal_) error = isHurried ? journal_->finish(SessionJournal::maxQuickBytes) : journal_->finish();
    driver_.reset();
    session_.sinks().follow(nullptr);
    return error + (error.empty() || recordingError_.empty() ? "" : "; ") + recordingError_;
}

void Rig::close() {
    driver_.reset();
    session_.sinks().follow(nullptr);
    output_.close();
    for (const auto& sink : sinks_) session_.sinks().detach(*sink);
    sinks_.clear();
}

} // namespace physvib
