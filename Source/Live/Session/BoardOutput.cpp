// SPDX-License-Identifier: MIT
// Converts session events to board events: session time to board time, places to four amplitudes, tones that
// move or outlast a strike to segments.
#include "Live/Session/BoardOutput.h"
#include "Io/Text/NumberText.h"

namespace physvib {
namespace {

constexpr std::int64_t oneSecondNs = 1'000'000'000;
constexpr std::int64_t maxStepLatenessNs = 40'000'000; // the length of a segment: one this late has passed
                                                       // entirely
constexpr std::int64_t hurryMarginNs = 2'000'000;      // with less time, the segment is made longer

using State = BoardLinkStatus::State;
constexpr std::int64_t telemetryWaitNs = 1'500'000'000; // telemetry is sent once a second

std::string count(std::uint64_t n) { return std::to_string(n); }

std::string linkSummary(const BoardLinkStatus& s) {
    if (s.state == State::ready)
        return s.port + ": ready, needs " + fixedNumber(s.outputLatencyMs, 0) + " ms, " + count(s.sent) +
               " sent, " + count(s.thinned) + " thinned";
    if (!s.error.empty()) return s.error;
    return s.state == State::searching ? "looking for a board" : s.port + ": connecting";
}

std::vector<SinkState::Detail> makeDetails(const BoardLinkStatus& s) {
    const auto& t = s.telemetry;
    if (s.state != State::ready) return {{"Board", s.error.empty() ? "looking for it" : s.error, true}};
    std::vector<SinkState::Detail> details{
        {"Board", "ready, its clock " + fixedNumber(s.driftPpm, 0) + " ppm off"},
        {"Link", count(s.sent) + " sent, " + count(s.thinned) + " thinned, " + count(s.refused) + " refused",
         s.thinned + s.refused > 0}};
    if (s.segments > 0)
        details.push_back(
            {"What moves",
             count(s.segments) + " segments sent, " + count(s.coarseSegments) + " of them coarse",
             s.coarseSegments > 0});
    details.push_back(
        {"On board",
         count(t.played) + " played, " + count(t.late) + " late, " + count(t.dropped + t.lost) + " lost",
         t.late + t.dropped + t.lost > 0});
    if (t.guarded > 0)
        details.push_back({"Guard of the board", "acted " + count(t.guarded) + " times", true});
    return details;
}

// With anyBoard the link tries one port after the other, so the errors of single ports are not shown.
std::string describeError(const BoardLinkStatus& s, const std::string& port, double latencySeconds) {
    if (s.state == State::ready) {
        if (s.outputLatencyMs <= 1e3 * latencySeconds) return {};
        return "The board needs its strikes more than " + fixedNumber(1e3 * latencySeconds, 0) +
               " ms before they are felt: some come late there";
    }
    const bool wasReady = s.connections > 0;
    if (port == anyBoard)
        return wasReady ? "The board is gone; it is looked for on every serial port"
                        : "No board answers on any serial port";
    return "The board at " + port + (wasReady ? " is gone" : " does not answer") +
           "; it is looked for twice a second" + (s.error.empty() ? "" : " (" + s.error + ")");
}

} // namespace

BoardOutput::BoardOutput(std::string port, const PhantomPanner& panner, double latencySeconds)
    : port_{port}
    , link_{std::move(port)}
    , latencySeconds_{latencySeconds}
    , panner_{panner} {}

std::string BoardOutput::awaitReady(const std::function<bool()>& keepGoing) {
    std::string error = link_.awaitReady(keepGoing);
    const auto now = link_.status();
    latencySeconds_ = std::max(latencySeconds_, now.outputLatencyMs * 1e-3);
    isAwaited_ = true;
    telemetryAtStart_ = now.telemetry;
    return error;
}

void BoardOutput::follow(OutputClock* device) {
    if (device == device_) return;
    link_.setFeed({});
    device_ = device;
    if (device == nullptr) return link_.stopAll();
    setGains();
    link_.setFeed([this] { feed(); });
}

void BoardOutput::onCollision(const CollisionEvent& event) noexcept {
    // the board has no recordings; a full queue counts the events that it drops
    if (!isClip(event.sound)) events_.push(event);
}

SinkState BoardOutput::state() const {
    SinkState state = makeSinkState(link_.status(), port_, isAwaited_ ? HUGE_VAL : latencySeconds());
    state.lost += droppedInQueues();
    return state;
}

void BoardOutput::feed() {
    if (const OutputMoment felt = device_->latestMoment(); felt.steadyNs != 0) {
        clock_.add(felt);
        rateHz_ = felt.sampleRateHz;
    }
    if (clock_.isReady()) {
        processControls();
        for (CollisionEvent event; events_.pop(event);) {
            const bool isHeld = event.course.travelNs == 0 && outlastsStrike(event);
            if (isHeld) event.course = {event.x, event.y, event.durationNs, event.course.toneAgeNs, event.z};
            if (event.course.travelNs > 0 && isPlayable(event) &&
                2 * event.frequencyHz < limits::board::sampleRateHz)
                startPath(event);
            else
                pushStrike(event);
        }
        sendSteps();
        sendSegments();
    }
    setGains();
}

// A layout is applied with the first event of its time, other controls when their time is felt.
void BoardOutput::processControls() {
    for (RenderControl control; controls_.pop(control); controls_.done(control)) {
        if (control.panner != nullptr)
            pendingPanners_.push_back({control.timeNs, *control.panner});
        else
            pendingControls_.push_back(control);
    }
    const std::int64_t now = BoardLink::nowNs();
    const auto firstWaiting = std::find_if(pendingControls_.begin(), pendingControls_.end(),
                                           [&](const auto& c) { return clock_.steadyAt(c.timeNs) > now; });
    std::for_each(pendingControls_.begin(), firstWaiting, [this](const auto& c) { apply(c); });
    pendingControls_.erase(pendingControls_.begin(), firstWaiting);
}

void BoardOutput::apply(const RenderControl& control) {
    const auto channel = static_cast<std::size_t>(control.channel);
    if (control.kind == RenderControl::Kind::stopAll) {
        steps_.clear();
        paths_.clear();
        return link_.stopAll();
    }
    if (channel >= gains_.size()) return;
    if (control.kind == RenderControl::Kind::gain) gains_[channel] = control.value;
    if (control.kind == RenderControl::Kind::mute) isMuted_[channel] = control.value != 0.0f;
}

// Passes steps to the link only when it would send them, so that a path of a minute does not fill its queue.
void BoardOutput::sendSteps() {
    const std::int64_t untilNs = BoardLink::nowNs() + BoardLink::sendAheadMs * 1'000'000;
    for (BoardSteps& steps : steps_)
        while (!steps.isOver() && clock_.steadyAt(steps.nextNs()) < untilNs) pushStrike(steps.next());
    std::erase_if(steps_, [](const BoardSteps& steps) { return steps.isOver(); });
}

void BoardOutput::startPath(const CollisionEvent& event) {
    const auto soundingPaths = std::count_if(
        paths_.begin(), paths_.end(), [&](const BoardPath& path) { return path.endNs() > event.timeNs; });
    if (link_.supportsSegments() && soundingPaths < maxPaths)
        paths_.emplace_back(event, rateHz_);
    else
        steps_.emplace_back(event);
}

// Sends segments in order of due time, as many as there is room for, and not earlier than the link would send
// events of that time.
void BoardOutput::sendSegments() {
    const std::int64_t now = BoardLink::nowNs();
    std::erase_if(
        paths_, [&](const BoardPath& path) { return path.isOver() && clock_.steadyAt(path.endNs()) < now; });
    const auto dueNs = [](const BoardPath& path) { return path.isOver() ? INT64_MAX : path.nextNs(); };
    for (;;) {
        const auto first = std::min_element(
            paths_.begin(), paths_.end(), [&](const auto& a, const auto& b) { return dueNs(a) < dueNs(b); });
        if (first == paths_.end() || first->isOver()) return;
        const std::int64_t due = clock_.steadyAt(first->nextNs());
        if (due < now + BoardLink::sendAheadMs * 1'000'000 && link_.canSendSegment(due)) sendSegment(*first);
        // the line is gone or busy
        else if (due < now - maxStepLatenessNs)
            first->skip(), link_.refuseSegment();
        else
            return;
    }
}

void BoardOutput::sendSegment(BoardPath& path) {
    applyDueLayouts(path.nextNs());
    for (const BoardPath& other : paths_) path.continueFrom(other);
    const auto frameAt = [&](std::int64_t sinceNs) {
        return link_.frameAt(clock_.steadyAt(path.onsetNs() + sinceNs));
    };
    const BoardTime time{frameAt(0), frameAt(oneSecondNs) - frameAt(0)};
    const bool isHurried = clock_.steadyAt(path.nextNs()) < link_.segmentReadyNs() + hurryMarginNs;
    const auto segment = path.next(
        time, [this](const CollisionEvent& moved) { return gainsAt(moved); }, isHurried);
    if (!segment) return;
    link_.sendSegment(*segment, path.isCoarse());
    path.advance();
}

void BoardOutput::setGains() {
    std::array<double, limits::board::channels> channelGains{};
    for (std::size_t j = 0; j < channelGains.size(); ++j)
        if (!device_->isSilent() && !isMuted_[j]) channelGains[j] = device_->level() * gains_[j];
    if (channelGains == sentGains_) return;
    sentGains_ = channelGains;
    link_.setGains(channelGains);
}

void BoardOutput::pushStrike(const CollisionEvent& event) {
    if (!isPlayable(event)) return; // the renderer counts it
    applyDueLayouts(event.timeNs);
    link_.push({clock_.steadyAt(event.timeNs), toBoardEvent(event, gainsAt(event))});
}

void BoardOutput::applyDueLayouts(std::int64_t timeNs) {
    for (; !pendingPanners_.empty() && pendingPanners_.front().timeNs <= timeNs;
         pendingPanners_.erase(pendingPanners_.begin()))
        panner_ = pendingPanners_.front().panner;
}

PathGains::Gains BoardOutput::gainsAt(const CollisionEvent& event) const noexcept {
    PhantomPanner::Gains gains{};
    panner_.gainsAt(event, gains);
    return {gains[0], gains[1], gains[2], gains[3]};
}

SinkState makeSinkState(const BoardLinkStatus& s, const std::string& port, double latencySeconds) {
    SinkState state{"board",        s.state == State::ready, limits::board::channels,
                    s.sent,         s.thinned + s.refused,   describeError(s, port, latencySeconds),
                    linkSummary(s), makeDetails(s)};
    state.playsClips = false;
    return state;
}

std::string BoardOutput::summary(const std::function<bool()>& keepGoing) const {
    const std::int64_t end = BoardLink::nowNs() + telemetryWaitNs;
    const auto lastFrame = link_.status().telemetry.frame;
    while (link_.status().telemetry.frame == lastFrame && keepGoing() && BoardLink::nowNs() <= end)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const auto s = link_.status();
    const auto& t = s.telemetry;
    std::string lines;
    if (s.segments > 0)
        lines = count(s.segments) + " segments of moving or long strikes, " + count(s.coarseSegments) +
                " of them longer than their law asks for, as the line was full\n";
    std::string guarded;
    if (const auto times = static_cast<std::uint16_t>(t.guarded - telemetryAtStart_.guarded); times > 0)
        guarded = ", turned down " + count(times) + " times, as it would have been nearly direct current";
    return lines + "felt " + fixedNumber(s.outputLatencyMs, 1) + " ms after the call; " + count(s.sent) +
           " strikes sent, " + count(s.thinned + droppedInQueues()) + " thinned, " + count(s.refused) +
           " refused; the board played " + count(t.played - telemetryAtStart_.played) + ", " +
           count(t.late - telemetryAtStart_.late) + " late, " + count(t.dropped - telemetryAtStart_.dropped) +
           " dropped, " + count(t.lost) + " lost" + guarded + '\n';
}

} // namespace physvib
