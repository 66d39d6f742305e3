// SPDX-License-Identifier: GPL-3.0-or-later
// Stepping, handing over, and rendering L behind.
#include "Host/Session.h"
#include <algorithm>
#include <array>

namespace physvib {

// Realtime: what has been queued.
struct Session::LiveSource {
    Session& session;
    bool pop(CollisionEvent& event) noexcept { return session.queue_.pop(event); }
    bool pop(RenderControl& control) noexcept { return session.controls_.pop(control); }
};

// Non-realtime, the world is ours: step it whenever the queue runs dry, until `endNs`.
struct Session::OfflineSource {
    Session& session;
    std::int64_t endNs;
    bool pop(RenderControl& control) noexcept { return session.controls_.pop(control); }
    bool pop(CollisionEvent& event) {
        while (!session.queue_.pop(event)) {
            const bool hasMore = !session.handOver() || session.world_->timeNs() < endNs;
            if (!hasMore) return session.queue_.pop(event);
            if (session.world_->timeNs() < endNs) session.stepWorld();
        }
        return true;
    }
};

namespace {

std::unique_ptr<Simulation> worldOf(const SessionSetup& s) {
    return std::make_unique<Simulation>(s.scene, s.seed, s.stepsPerSecond, s.timing, s.location);
}

} // namespace

Session::Session(const SessionSetup& setup)
    : setup_{setup}
    , renderer_{std::make_unique<HapticRenderer<DesktopProfile>>()}
    , world_{worldOf(setup)} {
    made_.reserve(4096);
}

void Session::prepare(int sampleRateHz, int maxBlockFrames) {
    const std::lock_guard lock{worldMutex_};
    renderer_->prepare({sampleRateHz, setup_.channels, setup_.panner, setup_.limiterEnabled});
    setLaw(sampleRateHz, maxBlockFrames);
    world_ = worldOf(setup_);
    made_.clear();
    handed_ = 0;
    for (CollisionEvent unplayed; queue_.pop(unplayed);) {}
    sessionFrames_ = 0;
    slippedNs_ = 0;
    offline_ = false;
}

void Session::setLaw(int sampleRateHz, int maxBlockFrames) {
    law_ = {sampleRateHz, maxBlockFrames, setup_.stepsPerSecond, setup_.longestGapSeconds,
            HapticRenderer<DesktopProfile>::latencyFramesAt(sampleRateHz)};
}

void Session::resume(int sampleRateHz, int maxBlockFrames) {
    const std::lock_guard lock{worldMutex_};
    const std::int64_t now = sessionNs(sessionFrames_);
    const std::int64_t frames = FrameClock{sampleRateHz}.at(now).frame;
    setLaw(sampleRateHz, maxBlockFrames);
    renderer_->moveTo(sampleRateHz, std::max<std::int64_t>(0, frames - playOutFrames() + law_.limiterFrames));
    sessionFrames_ = frames;
}

std::int64_t Session::post(RenderControl control) noexcept {
    control.timeNs = sessionNs(sessionFrames_.load(std::memory_order_acquire));
    return controls_.push(control) ? control.timeNs : -1;
}

int Session::advance() {
    const std::lock_guard lock{worldMutex_};
    if (offline_.load(std::memory_order_acquire)) return 0;
    const std::int64_t now = sessionNs(sessionFrames_.load(std::memory_order_acquire));
    const auto most = static_cast<int>(maxCatchUpSeconds * setup_.stepsPerSecond);
    int steps = 0;
    while (world_->timeNs() + slippedNs() < now && steps < most) {
        stepWorld();
        ++steps;
    }
    if (steps == most && world_->timeNs() + slippedNs() < now) slippedNs_ = now - world_->timeNs();
    handOver();
    return steps;
}

void Session::stepWorld() {
    const std::size_t before = made_.size();
    world_->step(made_);
    for (std::size_t i = before; i < made_.size(); ++i) made_[i].timeNs += slippedNs();
}

// Queues what has been made; true if nothing is left. The mutex is held.
bool Session::handOver() {
    while (handed_ < made_.size() && queue_.push(made_[handed_])) ++handed_;
    if (handed_ < made_.size()) return false;
    made_.clear();
    handed_ = 0;
    return true;
}

std::int64_t Session::sessionNs(std::int64_t frames) const noexcept {
    return frames / law_.sampleRateHz * 1'000'000'000 + frames % law_.sampleRateHz * 1'000'000'000 / law_.sampleRateHz;
}

void Session::render(float* const* out, int frames, RenderMode mode) noexcept {
    if (mode == RenderMode::realtime) offline_.store(false, std::memory_order_release);
    const std::int64_t done = sessionFrames_.load(std::memory_order_relaxed);
    sessionFrames_.store(done + frames, std::memory_order_release);
    renderBehind(out, done, frames, mode);
    status_.write({renderer_->status(), sessionNs(done + frames)});
}

// The renderer's own output lags by the limiter's frames, which are part of L: it starts that much earlier.
void Session::renderBehind(float* const* out, std::int64_t done, int frames, RenderMode mode) noexcept {
    const std::int64_t start = playOutFrames() - renderer_->latencyFrames();
    const int silent = static_cast<int>(std::clamp<std::int64_t>(start - done, 0, frames));
    std::array<float*, limits::maxEnchanters> rest{};
    for (int j = 0; j < setup_.channels; ++j) {
        std::fill_n(out[j], silent, 0.0f);
        rest[static_cast<std::size_t>(j)] = out[j] + silent;
    }
    if (mode == RenderMode::offline) {
        const std::lock_guard lock{worldMutex_};
        offline_.store(true, std::memory_order_release);
        OfflineSource source{*this, sessionNs(done + frames)};
        if (silent < frames) renderer_->render(source, rest.data(), frames - silent);
        while (world_->timeNs() < source.endNs) stepWorld();
        handOver();
    } else if (silent < frames) {
        LiveSource source{*this};
        renderer_->render(source, rest.data(), frames - silent);
    }
}

std::uint64_t Session::drops() {
    const std::lock_guard lock{worldMutex_};
    return world_->drops();
}

} // namespace physvib
