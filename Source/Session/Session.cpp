// SPDX-License-Identifier: MIT
// Stepping, handing over, and rendering L behind.
#include "Session/Session.h"
#include <algorithm>
#include <array>

namespace physvib {

// Realtime: what has been queued.
struct Session::LiveSource {
    Session& session;
    FrameClock clock;
    std::int64_t nextFrame; // of the renderer
    bool pop(CollisionEvent& event) noexcept {
        if (!session.ownStrikes_.pop(event)) {
            if (!session.queue_.pop(event)) return false;
            session.leastMarginFrames_ = std::min(session.leastMarginFrames_, clock.at(event.timeNs).frame - nextFrame);
        }
        if (session.heard_) session.heard_->tell(event);
        return true;
    }
    bool pop(RenderControl& control) noexcept { return session.popControl(control); }
};

// Non-realtime, the world is ours: step it whenever the queue runs dry, until `endNs`.
struct Session::OfflineSource {
    Session& session;
    std::int64_t endNs;
    bool pop(RenderControl& control) noexcept { return session.popControl(control); }
    bool pop(CollisionEvent& event) {
        if (!take(event)) return false;
        if (session.heard_) session.heard_->tell(event);
        return true;
    }
    bool take(CollisionEvent& event) {
        if (session.ownStrikes_.pop(event)) return true;
        while (!session.queue_.pop(event)) {
            const bool hasMore = !session.handOver() || session.world_.timeNs() < endNs;
            if (!hasMore) return session.queue_.pop(event);
            if (session.world_.timeNs() < endNs) session.moveWorld(endNs);
        }
        return true;
    }
};

Session::Session(const SessionSetup& setup)
    : setup_{setup}
    , renderer_{std::make_unique<HapticRenderer<DesktopProfile>>()}
    , heard_{setup.contactSound ? std::make_unique<HeardContacts>(*setup.contactSound) : nullptr}
    , told_{setup.boardSeconds > 0.0 ? std::make_unique<ToldEvents>() : nullptr}
    , state_{std::make_shared<const Scene>(setup.scene), setup.seed}
    , world_{setup.run(), setup.shaping, setup.log != LogUse::none} {
    made_.reserve(4096);
    std::ranges::copy(setup.ceilings, ceilings_.begin());
    world_.start(0, state_.scene, state_.seed);
}

void Session::prepare(int sampleRateHz, int maxBlockFrames) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    renderer_->prepare({.sampleRateHz = sampleRateHz,
                        .channels = setup_.channels,
                        .panner = setup_.panner,
                        .limiterEnabled = setup_.limiterEnabled,
                        .ceilings = setup_.ceilings,
                        .equalised = setup_.equalised});
    setLaw(sampleRateHz, maxBlockFrames);
    setContacts();
    if (heard_) heard_->prepare(sampleRateHz);
    sessionFrames_ = 0;
    restartFrame_ = -1;
    takeUp();
    world_.forget();
    made_.clear();
    handed_ = 0;
    steppedNs_ = 0;
    for (CollisionEvent unplayed; queue_.pop(unplayed) || ownStrikes_.pop(unplayed);) {}
    for (RenderInput undone; ownInputs_.pop(undone);) {}
    ownSpawns_ = 0;
    ownNames_.fill({});
    for (RenderControl undone; controls_.pop(undone) || ownControls_.pop(undone);) {}
    check_.reset();
    controlLog_ = {};
    if (!setup_.recordings.empty() && setup_.log != LogUse::none) controlLog_.recordings.push_back({0, filesOf(setup_.recordings)});
    slippedNs_ = 0;
    leastMarginFrames_ = noMargin;
    offline_ = false;
    isDriven_ = false;
    slowness_ = 1;
    stepsWanted_ = 0;
}

void Session::setLaw(int sampleRateHz, int maxBlockFrames) {
    law_ = {sampleRateHz, maxBlockFrames, setup_.stepsPerSecond, setup_.longestGapSeconds,
            HapticRenderer<DesktopProfile>::latencyFramesAt(sampleRateHz), setup_.boardSeconds};
    playOutFrames_ = law_.playOutFrames();
    grownFrames_ = 0;
}

void Session::resume(int sampleRateHz, int maxBlockFrames) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    catchUp(); // what the old L allowed for, the new one may not
    const FrameClock clock{sampleRateHz};
    const std::int64_t frames = clock.at(nowNs()).frame;
    if (const std::int64_t restart = restartFrame_.load(std::memory_order_acquire); restart >= 0) restartFrame_ = clock.at(sessionNs(restart)).frame;
    setLaw(sampleRateHz, maxBlockFrames);
    const auto rendered = std::max<std::int64_t>(0, frames - playOutFrames() + law_.limiterFrames);
    renderer_->moveTo(sampleRateHz, rendered);
    if (heard_) heard_->moveTo(sampleRateHz, rendered);
    setContacts();
    sessionFrames_ = frames;
}

// Recordings that sounded before a change of rate stop there.
void Session::setContacts() {
    renderer_->setContacts(recordingSet(setup_.recordings).sounds.contacts());
}

const Session::RecordingSet& Session::recordingSet(const std::vector<ContactRecording>& recordings) {
    const auto known = std::ranges::find_if(recordingSets_, [&](const RecordingSet& set) { return set.sampleRateHz == law_.sampleRateHz && set.recordings == recordings; });
    if (known != recordingSets_.end()) return *known;
    return recordingSets_.emplace_back(RecordingSet{recordings, law_.sampleRateHz, {recordings, law_.sampleRateHz}});
}

bool Session::popControl(RenderControl& control) noexcept {
    if (!ownControls_.pop(control) && !controls_.pop(control)) return false;
    if (heard_) heard_->tell(control);
    return true;
}

bool Session::strike(CollisionEvent event, int frame) noexcept {
    event = setup_.shaping(event);
    event.timeNs = sessionNs(sessionFrames_.load(std::memory_order_relaxed) + frame);
    return ownStrikes_.push(event);
}

bool Session::control(RenderControl control, int frame) noexcept {
    control.timeNs = sessionNs(sessionFrames_.load(std::memory_order_relaxed) + frame);
    return ownControls_.push(control);
}

bool Session::silence(int frame) noexcept {
    const std::int64_t now = sessionFrames_.load(std::memory_order_relaxed) + frame;
    RenderControl control;
    control.kind = RenderControl::Kind::silence;
    control.timeNs = sessionNs(std::max<std::int64_t>(0, now - playOutFrames() + renderer_->latencyFrames())); // which leaves us now
    control.untilNs = sessionNs(now);
    return ownControls_.push(control);
}

bool Session::perform(RenderInput input, int frame) noexcept {
    input.timeNs = sessionNs(sessionFrames_.load(std::memory_order_relaxed) + frame);
    return ownInputs_.push(input);
}

int Session::advance(const StepWatch& goesOn) {
    const std::lock_guard lock{worldMutex_};
    if (offline_.load(std::memory_order_acquire)) return 0;
    isDriven_.store(true, std::memory_order_release);
    takeUp();
    return catchUp(goesOn);
}

int Session::catchUp(const StepWatch& goesOn) {
    const std::int64_t now = nowNs();
    if (const std::int64_t lag = now - world_.timeNs(); lag > longestLagNs()) {
        slippedNs_ += lag - law_.safeLagNs();
        world_.standStill(lag - law_.safeLagNs());
    }
    takeOwnInputs(); // what R did until `now` is in the queue: it came before the frames were told
    int steps = 0;
    for (; world_.timeNs() < now && (steps == 0 || !goesOn || goesOn(world_.timeNs())); ++steps) {
        moveWorld(now);
        handOver(); // the next block may begin before the last step
    }
    handOver();
    return steps;
}

// One step; or none, where the world stands still. It is before `untilNs`. The world mutex is held.
void Session::moveWorld(std::int64_t untilNs) {
    const int slowness = slowness_.load(std::memory_order_relaxed);
    if (slowness == 0) {
        if (stepsWanted_.load(std::memory_order_relaxed) == 0) return world_.standStill(untilNs - world_.timeNs());
        stepsWanted_.fetch_sub(1, std::memory_order_relaxed);
    }
    const std::int64_t before = world_.timeNs();
    world_.step(made_);
    if (slowness > 1) world_.standStill((slowness - 1) * (world_.timeNs() - before));
}

// Starts a new take if one is wanted. The world mutex is held.
void Session::takeUp() {
    const std::int64_t frame = restartFrame_.exchange(-1, std::memory_order_acquire);
    const std::lock_guard lock{stateMutex_};
    if (frame < 0 && !isStateNew_) return;
    world_.start(frame < 0 ? nowNs() : sessionNs(frame), state_.scene, state_.seed);
    isStateNew_ = false;
}

// Queues what has been made; true if nothing is left. The world mutex is held.
bool Session::handOver() {
    for (; handed_ < made_.size() && queue_.push(made_[handed_]); ++handed_)
        if (told_) told_->events.push(made_[handed_]); // a full queue counts what nobody takes
    if (handed_ < made_.size()) return false;
    made_.clear();
    handed_ = 0;
    steppedNs_.store(world_.timeNs(), std::memory_order_release);
    return true;
}

std::int64_t Session::sessionNs(std::int64_t frames) const noexcept {
    return frames / law_.sampleRateHz * 1'000'000'000 + frames % law_.sampleRateHz * 1'000'000'000 / law_.sampleRateHz;
}

std::int64_t Session::nextFeltNs() const noexcept { return sessionNs(sessionFrames_.load(std::memory_order_relaxed) - playOutFrames()); }

std::int64_t Session::nowNs() const noexcept { return sessionNs(sessionFrames_.load(std::memory_order_acquire)); }

// A microsecond less than D lets pass: frames in whole nanoseconds do not add up to the last one.
std::int64_t Session::framesMissing(int frames) const noexcept {
    const std::int64_t lagNs = sessionNs(sessionFrames_.load(std::memory_order_relaxed) + frames) - steppedNs_.load(std::memory_order_acquire);
    const std::int64_t missingNs = lagNs - longestLagNs() + 1000;
    const FrameClock clock{law_.sampleRateHz};
    return missingNs > 0 ? clock.at(missingNs).frame : -clock.at(-missingNs).frame + 1;
}

void Session::lengthen(std::int64_t frames) noexcept {
    playOutFrames_.fetch_add(frames, std::memory_order_relaxed);
    grownFrames_.fetch_add(frames, std::memory_order_release);
}

// L first: D, which reads both the other way round, must not take a gap for a stall.
void Session::wait(int frames) noexcept {
    offline_.store(false, std::memory_order_release);
    lengthen(frames);
    sessionFrames_.fetch_add(frames, std::memory_order_release);
}

void Session::render(float* const* out, int frames, RenderMode mode) noexcept {
    if (mode == RenderMode::realtime) offline_.store(false, std::memory_order_release);
    else isDriven_.store(true, std::memory_order_release);
    if (!isDriven_.load(std::memory_order_acquire)) {
        for (int j = 0; j < outputs(); ++j) std::fill_n(out[j], frames, 0.0f);
        return;
    }
    const std::int64_t done = sessionFrames_.load(std::memory_order_relaxed);
    sessionFrames_.store(done + frames, std::memory_order_release);
    renderBehind(out, done, frames, mode);
    status_.write({renderer_->status(), sessionNs(done + frames), leastMarginFrames_, ownStrikes_.overflows() + ownControls_.overflows() + ownInputs_.overflows() + (heard_ ? heard_->lost() : 0)});
}

// The renderer's own output lags by the limiter's frames, which are part of L: it starts that much earlier.
void Session::renderBehind(float* const* out, std::int64_t done, int frames, RenderMode mode) noexcept {
    const std::int64_t start = playOutFrames() - renderer_->latencyFrames();
    const int silent = static_cast<int>(std::clamp<std::int64_t>(start - done, 0, frames));
    std::array<float*, limits::maxEnchanters + 1> rest{};
    for (int j = 0; j < outputs(); ++j) {
        std::fill_n(out[j], silent, 0.0f);
        rest[static_cast<std::size_t>(j)] = out[j] + silent;
    }
    if (mode == RenderMode::offline) {
        renderOwnWorld(rest.data(), frames - silent, sessionNs(done + frames));
    } else if (silent < frames) {
        LiveSource source{*this, FrameClock{law_.sampleRateHz}, done + silent - start};
        renderer_->render(source, rest.data(), frames - silent);
    }
    if (heard_ && silent < frames) heard_->render(rest[static_cast<std::size_t>(setup_.channels)], frames - silent);
}

void Session::renderOwnWorld(float* const* out, int frames, std::int64_t endNs) {
    const std::lock_guard lock{worldMutex_};
    offline_.store(true, std::memory_order_release);
    takeUp();
    takeOwnInputs();
    OfflineSource source{*this, endNs};
    if (frames > 0) renderer_->render(source, out, frames);
    while (world_.timeNs() < endNs) moveWorld(endNs);
    handOver();
}

std::uint64_t Session::drops() const {
    const std::lock_guard lock{worldMutex_};
    return world_.drops();
}

} // namespace physvib
