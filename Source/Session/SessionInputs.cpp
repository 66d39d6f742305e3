// SPDX-License-Identifier: MIT
// What comes from outside while a session plays: inputs, controls, other scenes, and the log of it all.
#include "Session/Session.h"
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
    control.timeNs = nowNs();
    if (!controls_.push(control)) return -1;
    if (told_) told_->controls.push(control);
    if (control.kind == RenderControl::Kind::ceiling && control.channel >= 0 && control.channel < setup_.channels) {
        auto& most = ceilings_[static_cast<std::size_t>(control.channel)];
        most = std::max(most.load(), control.value);
    }
    if (setup_.log == LogUse::none) return control.timeNs;
    if (control.kind == RenderControl::Kind::panner)
        controlLog_.panners.push_back({control.timeNs, control.panner});
    else
        controlLog_.channels.push_back({control.timeNs, control.kind, control.channel, control.value});
    return control.timeNs;
}

std::int64_t Session::useRecordings(std::vector<ContactRecording> recordings) {
    const std::lock_guard lock{inputMutex_};
    const std::int64_t now = nowNs();
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

bool Session::play(std::span<const CollisionEvent> strikes) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    return addStrikes(strikes, nowNs());
}

bool Session::playAt(std::span<const CollisionEvent> strikes) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    return addStrikes(strikes, 0);
}

std::int64_t Session::presentNs() const {
    const std::lock_guard lock{inputMutex_};
    return nowNs();
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
    const auto move = [](auto& from, auto& to) {
        std::ranges::move(from, std::back_inserter(to));
        from.clear();
    };
    move(controlLog_.panners, log.panners);
    move(controlLog_.channels, log.channels);
    move(controlLog_.recordings, log.recordings);
    move(controlLog_.strikes, log.strikes);
    world_.moveLog(log.takes);
    return std::min(nowNs(), world_.timeNs());
}

SessionSize Session::size() const {
    const std::lock_guard lock{worldMutex_};
    return world_.size();
}

std::int64_t Session::readPoses(std::vector<BodyPose>& poses) const {
    const std::lock_guard lock{worldMutex_};
    world_.readPoses(poses);
    return world_.timeNs();
}

} // namespace physvib
