// SPDX-License-Identifier: MIT
// Stepping, handing over, and rendering L behind.
#include "Session/Session.h"
#include "Core/ClipNumber.h"
#include <algorithm>
#include <array>

namespace physvib {

// Realtime: what has been queued.
struct Session::LiveSource {
    Session& session;
    FrameClock clock;
    std::int64_t nextFrame; // of the renderer
    bool pop(CollisionEvent& event) noexcept {
        if (!session.popStrike(event)) {
            if (!session.queue_.pop(event)) return false;
            session.leastMarginFrames_ = std::min(session.leastMarginFrames_, clock.at(event.timeNs).frame - nextFrame);
        }
        if (session.heard_ && !isClip(event.frequencyHz)) session.heard_->tell(event);
        return true;
    }
    bool pop(RenderControl& control) noexcept { return session.popControl(control); }
    void struck(const CollisionEvent& event, std::int64_t frame) noexcept { session.mark(event, frame); }
};

// Non-realtime, the world is ours: step it whenever the queue runs dry, until `endNs`.
struct Session::OfflineSource {
    Session& session;
    std::int64_t endNs;
    bool pop(RenderControl& control) noexcept { return session.popControl(control); }
    void struck(const CollisionEvent& event, std::int64_t frame) noexcept { session.mark(event, frame); }
    bool pop(CollisionEvent& event) {
        if (!take(event)) return false;
        if (session.heard_ && !isClip(event.frequencyHz)) session.heard_->tell(event);
        return true;
    }
    bool take(CollisionEvent& event) {
        if (session.popStrike(event)) return true;
        while (!session.queue_.pop(event)) {
            const bool hasMore = !session.handOver() || session.world_.timeNs() < endNs;
            if (!hasMore) return session.queue_.pop(event);
            if (session.world_.timeNs() < endNs) session.moveWorld(endNs);
        }
        return true;
    }
};

Session::Session(const SessionSetup& setup)
    : WantedTake{{std::make_shared<const Scene>(setup.scene), setup.seed}}
    , OwnBirths{*this, setup}
    , setup_{setup}
    , renderer_{std::make_unique<HapticRenderer>()}
    , heard_{setup.contactSound ? std::make_unique<HeardContacts>(*setup.contactSound, setup.ears, setup.panner) : nullptr}
    , marks_{setup.marks ? std::make_unique<OnsetMarks>(*setup.marks) : nullptr}
    , world_{setup.run(), setup.shaping, setup.log != LogUse::none} {
    made_.reserve(1024); // of a step; more are rare
    std::ranges::copy(setup.ceilings, ceilings_.begin());
    const SessionState first = state();
    world_.start(0, first.scene, first.seed);
}

void Session::prepare(int sampleRateHz, int maxBlockFrames) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    renderer_->prepare({.sampleRateHz = sampleRateHz,
                        .channels = setup_.channels,
                        .panner = setup_.panner,
                        .limiterEnabled = setup_.limiterEnabled,
                        .ceilings = setup_.ceilings,
                        .modes = setup_.modes,
                        .equalised = setup_.equalised});
    setLaw(lawAt(sampleRateHz, maxBlockFrames), setup_.direct != Direct::no, setup_.direct == Direct::born);
    renderer_->setContacts(recordings_.at(sampleRateHz, setup_.recordings));
    if (heard_) heard_->prepare(sampleRateHz);
    if (marks_) marks_->prepare(sampleRateHz, -renderer_->latencyFrames());
    setFrames(firstFrame()); // the renderer begins with the first block where something may be felt in it
    setRestart(-1);
    takeUp();
    world_.forget(nowNs());
    made_.clear();
    handed_ = 0;
    steppedNs_ = nowNs();
    for (CollisionEvent unplayed; queue_.pop(unplayed);) {}
    for (RenderControl undone; controls_.pop(undone);) {}
    forgetBirths();
    check_.reset();
    controlLog_ = {};
    waiting_ = {};
    begun_.clear();
    panner_ = setup_.panner;
    lastControlNs_ = 0;
    stops_.clear();
    nextStopNs_ = never;
    if (!setup_.recordings.empty() && setup_.log != LogUse::none) controlLog_.recordings.push_back({0, filesOf(setup_.recordings)});
    if (setup_.log != LogUse::none) controlLog_.clips = clips_;
    slippedNs_ = 0;
    leastMarginFrames_ = noMargin;
    offline_ = false;
    isDriven_ = false;
    resetPace();
}

ClockLaw Session::lawAt(int sampleRateHz, int maxBlockFrames) const {
    return {sampleRateHz, maxBlockFrames, setup_.stepsPerSecond, setup_.longestGapSeconds, HapticRenderer::latencyFramesAt(sampleRateHz),
            sinks_.latencySeconds()};
}

void Session::resume(int sampleRateHz, int maxBlockFrames) {
    const std::scoped_lock lock{inputMutex_, worldMutex_};
    catchUp(); // what the old L allowed for, the new one may not
    const FrameClock clock{sampleRateHz};
    const std::int64_t frames = clock.at(nowNs()).frame;
    if (const std::int64_t restart = restartFrame(); restart >= 0) setRestart(clock.at(sessionNs(restart)).frame);
    setLaw(lawAt(sampleRateHz, maxBlockFrames), setup_.direct != Direct::no, setup_.direct == Direct::born);
    const auto rendered = std::max<std::int64_t>(0, frames - playOutFrames() + law().limiterFrames);
    renderer_->moveTo(sampleRateHz, rendered);
    if (heard_) heard_->moveTo(sampleRateHz, rendered);
    if (marks_) marks_->prepare(sampleRateHz, rendered - renderer_->latencyFrames());
    renderer_->setContacts(recordings_.at(sampleRateHz, setup_.recordings)); // recordings that sound stop
    setFrames(frames);
}

bool Session::popControl(RenderControl& control) noexcept {
    if (!popOwnControl(control) && !controls_.pop(control)) return false;
    if (heard_) heard_->tell(control);
    return true;
}

int Session::advance(const StepWatch& goesOn) {
    takeDueStops();
    const std::lock_guard lock{worldMutex_};
    if (offline_.load(std::memory_order_acquire)) return 0;
    isDriven_.store(true, std::memory_order_release);
    takeUp();
    return catchUp(goesOn);
}

int Session::catchUp(const StepWatch& goesOn) {
    const std::int64_t now = nowNs();
    if (const std::int64_t lag = now - world_.timeNs(); lag > longestLagNs()) {
        slippedNs_ += lag - law().safeLagNs();
        world_.standStill(lag - law().safeLagNs());
    }
    takeDue(now);
    takeOwnInputs(world_); // what R did until `now` is in the queue: it came before the frames were told
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
    const int slowness = this->slowness();
    if (slowness == 0 && !takeStep()) return world_.standStill(untilNs - world_.timeNs());
    const std::int64_t before = world_.timeNs();
    world_.step(made_);
    if (slowness > 1) world_.standStill((slowness - 1) * (world_.timeNs() - before));
}

// Starts a new take if one is wanted. The world mutex is held.
void Session::takeUp() {
    take([this](std::int64_t frame, const SessionState& state) { world_.start(frame < 0 ? nowNs() : sessionNs(frame), state.scene, state.seed); });
}

// Queues what has been made; true if nothing is left. The world mutex is held.
bool Session::handOver() {
    for (; handed_ < made_.size() && queue_.push(made_[handed_]); ++handed_) sinks_.made(made_[handed_]);
    if (handed_ < made_.size()) return false;
    made_.clear();
    handed_ = 0;
    steppedNs_.store(world_.timeNs(), std::memory_order_release);
    return true;
}

std::int64_t Session::framesMissing(int frames) const noexcept { return SessionTime::framesMissing(frames, steppedNs_); }

// The world first: whoever steps it must not take what is added for a stall.
void Session::startLater(std::int64_t frames) noexcept {
    if (frames <= 0) return;
    lengthen(frames);
    if (setup_.direct != Direct::born) return;
    setRestart(framesRendered() + frames);
    setFrames(framesRendered() + frames);
}

void Session::wait(int frames) noexcept {
    offline_.store(false, std::memory_order_release);
    waitFrames(frames);
}

void Session::render(float* const* out, int frames, RenderMode mode) noexcept {
    if (mode == RenderMode::realtime) offline_.store(false, std::memory_order_release);
    else isDriven_.store(true, std::memory_order_release);
    if (!isDriven_.load(std::memory_order_acquire)) {
        for (int j = 0; j < outputs(); ++j) std::fill_n(out[j], frames, 0.0f);
        return;
    }
    const std::int64_t done = tellFrames(frames);
    renderBehind(out, done, frames, mode);
    status_.write({renderer_->status(), sessionNs(done + frames), leastMarginFrames_, refused() + (heard_ ? heard_->lost() : 0)});
}

// The renderer's own output lags by the limiter's frames, which are part of L: it starts that much earlier.
void Session::renderBehind(float* const* out, std::int64_t done, int frames, RenderMode mode) noexcept {
    const std::int64_t start = playOutFrames() - renderer_->latencyFrames();
    const int silent = static_cast<int>(std::clamp<std::int64_t>(start - done, 0, frames));
    std::array<float*, limits::maxEnchanters + 3> rest{};
    for (int j = 0; j < outputs(); ++j) {
        std::fill_n(out[j], silent, 0.0f);
        rest[static_cast<std::size_t>(j)] = out[j] + silent;
    }
    if (mode == RenderMode::offline) {
        renderOwnWorld(rest.data(), frames - silent, sessionNs(done + frames));
    } else if (silent < frames) {
        LiveSource source{*this, FrameClock{law().sampleRateHz}, done + silent - start};
        renderer_->render(source, rest.data(), frames - silent);
    }
    if (heard_ && silent < frames) heard_->render(rest.data() + setup_.channels, frames - silent);
    if (marks_ && silent < frames) marks_->render(rest[static_cast<std::size_t>(outputs() - 1)], frames - silent);
}

void Session::renderOwnWorld(float* const* out, int frames, std::int64_t endNs) {
    takeDueStops();
    const std::lock_guard lock{worldMutex_};
    offline_.store(true, std::memory_order_release);
    takeUp();
    takeDue(endNs);
    takeOwnInputs(world_);
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
