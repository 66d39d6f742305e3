// SPDX-License-Identifier: MIT
// Opens and closes the parts of a live rig in the order that their threads require.
#include "Live/Rig/Rig.h"

namespace physvib {

ThreadDriver::ThreadDriver(Session& session, int stepsPerSecond, const std::atomic<bool>* ends)
    : session_{session}
    , stepNs_{std::max(poll, std::int64_t{1'000'000'000} / stepsPerSecond)}
    , ends_{ends}
    , thread_{[this] { run(); }} {}

ThreadDriver::~ThreadDriver() {
    isDestroyed_ = true;
    thread_.join();
}

void ThreadDriver::run() {
    raiseThreadPriority(false);
    while (!isOver()) {
        const std::int64_t begin = steadyNs();
        // a thread that draws a world too slow for real time waits a step or two, not until it has caught up
        session_.advance([&](auto) { return steadyNs() - begin <= mostHold && !isOver(); });
        const std::int64_t now = steadyNs(), left = session_.world().nextStepNs() - now;
        std::int64_t pause = std::max(left, std::int64_t{0}) + poll; // by then the block is rendered
        if (left > longestBlock) pause = 4 * poll;                   // the first block may come at any time
        if (session_.pulse().isStill(now)) pause = stepNs_;
        std::this_thread::sleep_for(std::chrono::nanoseconds{std::max(pause, (now - begin) / 8)});
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
    if (auto fault = connectSinks(); !fault.empty()) return fault;
    if (auto fault = openDevice(settings_.output); !fault.empty()) return fault;
    if (auto fault = beginRecording(); !fault.empty()) return fault;
    return beginJournal();
}

std::string Rig::connectSinks() {
    const auto keepGoing = [this] { return this->keepGoing(); };
    connectedAt_ = std::chrono::steady_clock::now();
    if (auto fault = openSinks(settings_.sinks, settings_.setup.panner,
                               settings_.awaitsSinks ? std::function<bool()>{keepGoing} : nullptr, sinks_);
        !fault.empty())
        return fault;
    for (const auto& sink : sinks_) session_.sinks().attach(*sink);
    return {};
}

std::string Rig::openDevice(const AudioOutputSettings& wanted) {
    return deviceTrouble_ = output_.open(wanted);
}

std::string Rig::beginRecording() {
    if (settings_.recordPath.empty()) return {};
    recording_.emplace(settings_.recordPath, settings_.setup.channels, output_.sampleRateHz());
    if (auto fault = recording_->error(); !fault.empty()) return fault;
    recording_->tellBeginning(session_.timeline().outputLatencyFrames());
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
    if (settings_.ownThread) driver_.emplace(session_, settings_.setup.stepsPerSecond, isEnded_);
}

void Rig::step() {
    if (!settings_.ownThread && keepGoing()) session_.advance([this](auto) { return keepGoing(); });
}

std::string droppedWords(std::uint64_t events) {
    return events == 0 ? ""
                       : std::to_string(events) + (events == 1 ? " event was" : " events were") +
                             " lost, as no device ran";
}

void Rig::maintain() {
    deviceTrouble_ = output_.maintain();
    const std::uint64_t dropped = session_.pulse().dropped();
    eventTrouble_ = std::exchange(toldDropped_, dropped) == dropped ? "" : droppedWords(dropped);
}

std::vector<SinkState> Rig::sinkStates() const {
    std::vector<SinkState> states;
    for (const auto& sink : sinks_) states.push_back(sink->state());
    return states;
}

std::vector<RigTrouble> Rig::troubles() const {
    std::vector<RigTrouble> all;
    const auto add = [&all](const std::string& source, const std::string& words) {
        if (!words.empty()) all.push_back({source, words});
    };
    add("device", deviceTrouble_);
    add("events", eventTrouble_);
    const bool isPatient =
        !settings_.awaitsSinks && std::chrono::steady_clock::now() - connectedAt_ < patience;
    if (!isPatient)
        for (const SinkState& sink : sinkStates()) add(sink.name, sink.trouble);
    if (journal_) add("journal", journal_->news());
    if (recording_) add("recording", recording_->error());
    return all;
}

std::string Rig::trouble() const {
    std::string line;
    for (const RigTrouble& trouble : troubles()) line += (line.empty() ? "" : "; ") + trouble.words;
    return line;
}

std::string Rig::summary(std::string& trouble) const {
    std::string lines;
    for (const auto& sink : sinks_) {
        lines += sink->summary([this] { return keepGoing(); });
        const SinkState state = sink->state();
        if (trouble.empty() && !state.isReady)
            trouble = state.trouble.empty() ? "the " + state.name + " is gone" : state.trouble;
    }
    return lines;
}

// The journal's pending lines come first, because the rest may take long or hang.
void Rig::endFiles() {
    if (journal_) journal_->end(session_.status().sessionNs);
    if (recording_) recorded_ = recording_->finish();
}

std::string Rig::finish(bool isHurried) {
    std::string saved;
    if (journal_) saved = isHurried ? journal_->finish(SessionJournal::quickBytes) : journal_->finish();
    driver_.reset();
    session_.sinks().follow(nullptr);
    return saved + (saved.empty() || recorded_.empty() ? "" : "; ") + recorded_;
}

void Rig::close() {
    driver_.reset();
    session_.sinks().follow(nullptr);
    output_.close();
    for (const auto& sink : sinks_) session_.sinks().detach(*sink);
    sinks_.clear();
}

} // namespace physvib
