// SPDX-License-Identifier: MIT
// What comes from outside while a session plays: inputs, controls, other scenes, and the log of it all.
#include "Session/Session.h"
#include "Core/ClipNumber.h"
#include "Files/Disk/FileLimits.h"
#include <algorithm>
#include <iterator>
#include <utility>

namespace physvib {

std::string Session::act(Action action) {
    const std::lock_guard inputs{inputMutex_};
    for (;;) { // again if a new take began since the check
        if (const std::lock_guard lock{worldMutex_}; !check_ || checkedTake_ != world_.takeCount()) {
            check_.emplace(*world_.take().scene, setup_.log == LogUse::document ? sceneLimits::maxLiveInputs : InputCheck::endless);
            checkedTake_ = world_.takeCount();
        }
        if (std::string fault = check_->take(action); !fault.empty()) return fault;
        const std::lock_guard lock{worldMutex_};
        if (checkedTake_ != world_.takeCount()) continue;
        world_.addInput(nowNs(), std::move(action));
        return {};
    }
}

std::int64_t Session::post(RenderControl control) {
    const std::lock_guard lock{inputMutex_};
    postDueStops(nowNs());
    control.timeNs = toldNs();
    return postNow(control);
}

// At its own time, which is not before that of any other. The input mutex is held.
std::int64_t Session::postNow(RenderControl control) {
    control.timeNs = std::max(control.timeNs, lastControlNs_); // a stop ahead may have been told before
    if (!controls_.push(control)) return -1;
    lastControlNs_ = control.timeNs;
    sinks_.posted(control);
    if (control.kind == RenderControl::Kind::ceiling && control.channel >= 0 && control.channel < setup_.channels) {
        auto& most = ceilings_[static_cast<std::size_t>(control.channel)];
        most = std::max(most.load(), control.value);
    }
    if (control.kind == RenderControl::Kind::panner) panner_ = control.panner;
    if (setup_.log == LogUse::none) return control.timeNs;
    if (control.kind == RenderControl::Kind::panner)
        controlLog_.panners.push_back({control.timeNs, control.panner});
    else
        controlLog_.channels.push_back({control.timeNs, control.kind, control.channel, control.value});
    return control.timeNs;
}

std::int64_t Session::useRecordings(std::vector<ContactRecording> recordings) {
    const std::lock_guard lock{inputMutex_};
    const std::int64_t now = toldNs();
    if (recordings == setup_.recordings) return now;
    RenderControl control;
    control.timeNs = now;
    control.kind = RenderControl::Kind::recordings;
    control.recordings = recordings_.at(law().sampleRateHz, recordings);
    if (!controls_.push(control)) return -1;
    if (setup_.log != LogUse::none) controlLog_.recordings.push_back({now, filesOf(recordings)});
    setup_.recordings = std::move(recordings);
    return now;
}

// The input mutex is held.
bool Session::hasRoomFor(std::span<const ClipSound> channels) const {
    const auto rates = recordings_.rates();
    double samples = 0.0;
    const auto add = [&](const ClipSound& sound) { samples += sound.samplesAt(rates); };
    std::ranges::for_each(channels, add);
    std::ranges::for_each(recordings_.clips(), add);
    return samples <= limits::maxRecordingSamples && clips_.size() + channels.size() <= mostClips;
}

// Brought to a rate without the mutex: that takes long.
std::optional<int> Session::keepClip(std::span<const ContactRecording> channels) {
    std::vector<ClipSound> sounds(channels.begin(), channels.end());
    for (std::vector<int> rates;;) {
        for (ClipSound& sound : sounds) std::ranges::for_each(rates, [&](int rate) { sound.at(rate); });
        const std::lock_guard lock{inputMutex_};
        const auto isFirst = [&](const ClipFile& kept) { return kept.channel == 0 && kept.file.path == channels[0].file.path && kept.file.hash == channels[0].file.hash; };
        const auto known = std::ranges::find_if(clips_, isFirst);
        if (known != clips_.end()) return static_cast<int>(known - clips_.begin());
        if (!hasRoomFor(sounds)) return std::nullopt;
        rates = recordings_.rates();
        if (!std::ranges::all_of(rates, [&](int rate) { return sounds.back().isAt(rate); })) continue;
        for (ClipSound& sound : sounds) recordings_.add(std::move(sound));
        return logClip(channels);
    }
}

// The number of the first. The input mutex is held.
int Session::logClip(std::span<const ContactRecording> channels) {
    const int first = static_cast<int>(clips_.size());
    for (int j = 0; j < std::ssize(channels); ++j) {
        ClipFile& file = clips_.emplace_back(ClipFile{channels[static_cast<std::size_t>(j)].file, j});
        file.file.frequencyHz = clipFrequencyHz(first + j);
        if (setup_.log != LogUse::none) controlLog_.clips.push_back(file);
    }
    return first;
}

bool Session::play(std::span<const CollisionEvent> strikes) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    return addStrikes(strikes, toldNs());
}

bool Session::playAt(std::span<const CollisionEvent> strikes) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    return addStrikes(strikes, 0);
}

bool Session::schedule(std::span<const CollisionEvent> strikes) {
    const std::lock_guard lock{worldMutex_};
    if (!std::ranges::all_of(strikes, [](const CollisionEvent& e) { return isPlayable(e); }) || !waiting_.add(strikes)) return false;
    takeDue(nowNs());
    handOver();
    return true;
}

// The world mutex is held.
void Session::takeDue(std::int64_t untilNs) {
    std::vector<CollisionEvent> due;
    waiting_.take(untilNs, due);
    std::ranges::transform(due, std::back_inserter(made_), setup_.shaping);
    if (setup_.log != LogUse::none) std::ranges::move(due, std::back_inserter(begun_));
}

bool Session::stopAt(std::int64_t timeNs) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    if (stops_.size() == mostStops) return false;
    const std::int64_t now = nowNs();
    timeNs = std::max(timeNs, toldNs());
    takeDue(now);
    handOver();
    waiting_.forget(timeNs);
    stops_.insert(std::ranges::upper_bound(stops_, timeNs), timeNs);
    postDueStops(now);
    return true;
}

// Those whose time has come by then: a control of a later time must not be logged before them. The input mutex is held.
void Session::postDueStops(std::int64_t untilNs) {
    RenderControl stop;
    stop.kind = RenderControl::Kind::stopAll;
    while (!stops_.empty() && stops_.front() <= untilNs) {
        stop.timeNs = stops_.front();
        if (postNow(stop) < 0) break; // the queue is full: with the next call
        stops_.erase(stops_.begin());
    }
    nextStopNs_ = stops_.empty() ? never : stops_.front();
}

void Session::takeDueStops() {
    const std::int64_t now = nowNs();
    if (nextStopNs_ > now) return;
    const std::lock_guard lock{inputMutex_};
    postDueStops(now);
}

PhantomPanner Session::panner() const {
    const std::lock_guard lock{inputMutex_};
    return panner_;
}

std::int64_t Session::presentNs() const {
    const std::lock_guard lock{inputMutex_};
    return nowNs();
}

double Session::directSeconds() const {
    const std::lock_guard lock{inputMutex_};
    return static_cast<double>(law().directFrames()) / law().sampleRateHz;
}

std::int64_t Session::toldAheadNs() const {
    const std::lock_guard lock{inputMutex_};
    return leadNs();
}

double Session::playOutSeconds() const {
    const std::lock_guard lock{inputMutex_};
    return static_cast<double>(playOutFrames()) / law().sampleRateHz;
}

int Session::sampleRateHz() const {
    const std::lock_guard lock{inputMutex_};
    return law().sampleRateHz;
}

// Both mutexes are held.
bool Session::addStrikes(std::span<const CollisionEvent> strikes, std::int64_t startNs) {
    const auto isTimely = [](const CollisionEvent& e) { return isPlayable(e) && e.timeNs < limits::maxTimeNs / 2; };
    if (!std::ranges::all_of(strikes, isTimely)) return false;
    for (CollisionEvent strike : strikes) {
        strike.timeNs += startNs;
        made_.push_back(setup_.shaping(strike));
        if (setup_.log != LogUse::none) controlLog_.strikes.push_back(strike);
    }
    handOver();
    return true;
}

void Session::restart(int offset) noexcept {
    setRestart(framesRendered() + offset);
}

std::int64_t Session::readLog(SessionLog& log) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    if (setup_.log == LogUse::none) return nowNs();
    postDueStops(nowNs());
    const auto move = [](auto& from, auto& to) {
        std::ranges::move(from, std::back_inserter(to));
        from.clear();
    };
    move(controlLog_.panners, log.panners);
    move(controlLog_.channels, log.channels);
    move(controlLog_.recordings, log.recordings);
    move(controlLog_.clips, log.clips);
    move(controlLog_.strikes, log.strikes);
    move(begun_, log.strikes);
    world_.moveLog(log.takes);
    return std::min(nowNs(), world_.timeNs());
}

SessionSize Session::size() const {
    const std::lock_guard lock{worldMutex_};
    SessionSize size = world_.size();
    size.strikes = waiting_.size();
    return size;
}

std::int64_t Session::readPoses(std::vector<BodyPose>& poses) const {
    const std::lock_guard lock{worldMutex_};
    world_.readPoses(poses);
    return world_.timeNs();
}

} // namespace physvib
