// SPDX-License-Identifier: GPL-3.0-or-later
// PluginRuns: first what other threads do, then what the render thread does; then Stepper, the world thread.
#include "PluginRuns.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/InputCheck.h"
#include <algorithm>
#include <stdexcept>
#include <utility>

namespace physvib {
namespace {

// Throws std::invalid_argument for a wrong scene or group. Each check visits all bodies, so groups are
// checked together, as many as fit into a scene; if that fails, one by one, for the error of the wrong one.
void checkGroups(const SessionSetup& setup) {
    const auto require = [](const std::string& error) {
        if (!error.empty()) throw std::invalid_argument(error);
    };
    require(validate(setup.scene));
    std::vector<Action> actions;
    std::size_t first = 0;
    const auto check = [&](std::size_t end) {
        if (!InputCheck{setup.scene}.accept(actions).empty())
            for (std::size_t i = first; i < end; ++i)
                require(InputCheck{setup.scene}.accept(setup.groups[i]));
        actions.clear();
        first = end;
    };
    for (std::size_t i = 0; i < setup.groups.size(); ++i) {
        const auto& group = setup.groups[i];
        if (setup.scene.inputs.size() + actions.size() + group.size() > sceneLimits::maxInputs) check(i);
        actions.insert(actions.end(), group.begin(), group.end());
    }
    check(setup.groups.size());
}

bool followsHost(const RunSpec& spec) noexcept { return spec.settings.transport != TransportMode::free; }

} // namespace

void PluginRuns::set(SessionSetup setup, const RenderSettings& settings, std::vector<Strip> strips) {
    checkGroups(setup);
    const std::lock_guard setLock{settingsMutex_};
    const auto before = [this] {
        const std::lock_guard lock{mutex_};
        return spec_;
    }();
    for (;;) { // a run is built without the mutex, so that the worlds that play are stepped meanwhile
        std::unique_lock lock{mutex_};
        const int rate = sampleRateHz_, block = blockFrames_;
        const double delaySeconds = detectionDelaySeconds_;
        RunSpec spec{setup, settings, before ? before->generation + 1 : 1};
        setLongestGap(spec);
        lock.unlock();
        const auto newSpec = std::make_shared<const RunSpec>(std::move(spec));
        std::unique_ptr<PluginRun> run;
        if (block > 0)
            run = makeRun(newSpec, rate, block);
        else // throws if it cannot be simulated
            Simulation{newSpec->setup.scene, newSpec->setup.seed, newSpec->setup.stepsPerSecond};
        lock.lock();
        // the host has prepared us meanwhile
        if (rate != sampleRateHz_ || block != blockFrames_ || delaySeconds != detectionDelaySeconds_)
            continue;
        strips_ = std::move(strips);
        return installRun(newSpec, std::move(run));
    }
}

void PluginRuns::setStrips(std::vector<Strip> strips) {
    const std::lock_guard lock{mutex_};
    strips_ = std::move(strips);
    sendStripsToRuns();
}

// Called with mutex_ locked. If a run's queue is full, the next tick sends its strips again.
void PluginRuns::sendStripsToRuns() {
    for (auto& run : runs_)
        if (run->generation() == spec_->generation && !run->isReleased.load(std::memory_order_acquire))
            run->send(strips_);
}

// Makes `run` the spare one, and publishes the latencies of its settings. Called with mutex_ locked.
void PluginRuns::installRun(std::shared_ptr<const RunSpec> spec, std::unique_ptr<PluginRun> run) {
    spec_ = std::move(spec);
    newestGeneration_.store(spec_->generation, std::memory_order_release);
    errorText_.clear();
    canBuild_ = true;
    if (!run) return;
    run->send(strips_);
    const auto& setup = spec_->setup;
    ticksPerSecond_ =
        setup.hasWorld ? StepPace::ticksPerSecond(setup.stepsPerSecond) : StepPace::worldlessTicksPerSecond;
    idleSeconds_ =
        setup.hasWorld ? StepPace::idleSeconds(setup.stepsPerSecond) : StepPace::worldlessIdleSeconds;
    safeFrames_ = run->latencyFrames(StepTiming::safe);
    tightFrames_ = run->latencyFrames(StepTiming::tight);
    directFrames_ = setup.direct == Direct::fromStart ? run->session.timeline().inputLatencyFrames() : 0;
    runs_.push_back(std::move(run));
    PluginRun* const unused = spareRun_.exchange(runs_.back().get(), std::memory_order_acq_rel);
    if (unused) unused->isReleased = true;
}

// L must cover the longest time between two ticks, or the delay of beat detection if that is longer. With a
// world, L includes two more steps, which the delay may use up. Called with mutex_ locked.
void PluginRuns::setLongestGap(RunSpec& spec) const noexcept {
    auto& setup = spec.setup;
    const double delaySeconds = spec.detectionDelaySeconds =
        setup.direct == Direct::no ? detectionDelaySeconds_ : 0.0;
    setup.longestGapSeconds = setup.hasWorld ? std::max(StepPace::longestGapSeconds(setup.stepsPerSecond),
                                                        delaySeconds - 2.0 / setup.stepsPerSecond)
                                             : delaySeconds;
}

std::unique_ptr<PluginRun> PluginRuns::makeRun(std::shared_ptr<const RunSpec> spec, int sampleRateHz,
                                               int blockFrames) const {
    return std::make_unique<PluginRun>(std::move(spec), sampleRateHz, blockFrames, timing(), hasMusic_);
}

void PluginRuns::prepare(int sampleRateHz, int blockFrames, double detectionDelaySeconds, bool hasMusic) {
    release();
    std::unique_lock lock{mutex_};
    detectionDelaySeconds_ = detectionDelaySeconds;
    hasMusic_ = hasMusic;
    if (!spec_) return;
    auto spec = *spec_;
    setLongestGap(spec);
    spec_ = std::make_shared<const RunSpec>(std::move(spec));
    sampleRateHz_ = sampleRateHz;
    blockFrames_ = blockFrames;
    startedRuns_ = 0;
    delayedBlocks_ = endedLateEvents_ = 0;
    endedStalledNs_ = 0;
    steppedBlocks_ = 0;
    isStartRequested_ = false;
    status_.write({});
    installRun(spec_, makeRun(spec_, sampleRateHz, blockFrames));
    isStopping_ = false;
    if (isManuallyStepped_) return;
    builder_ = std::thread{[this] { runBuilder(); }};
    lock.unlock(); // Stepper locks its own mutex before ours
    stepper_.emplace();
    (*stepper_)->add(*this);
}

void PluginRuns::release() {
    isStopping_ = true; // first: tick() has locked mutex_, and ends its advance within one step
    if (stepper_) {
        (*stepper_)->remove(*this);
        stepper_.reset();
    }
    { const std::lock_guard lock{mutex_}; } // otherwise the builder could miss the notification
    workCondition_.notify_all();
    if (builder_.joinable()) builder_.join();
    const std::lock_guard lock{mutex_};
    for (auto& run : runs_) logPlayed(*run);
    current_ = nextRun_ = nullptr;
    endingCount_ = 0;
    spareRun_ = nullptr;
    hasNextRun_ = false;
    runs_.clear();
    sampleRateHz_ = blockFrames_ = 0;
}

void PluginRuns::tick() {
    std::unique_lock lock{mutex_};
    sendStripsToRuns();
    for (auto& run : runs_) {
        if (run->isReleased.load(std::memory_order_acquire)) continue;
        // so that release() waits for one step of a slow world, not for all that are due
        run->session.world().tryTo([&] { run->session.advance([this](auto) { return !isStopping_; }); });
        logPlayed(*run);
    }
    if (!hasWork()) return;
    if (isManuallyStepped_) return tryToPrepareSpare(lock);
    lock.unlock();
    workCondition_.notify_one();
}

void PluginRuns::runBuilder() {
    std::unique_lock lock{mutex_};
    for (;;) {
        workCondition_.wait(lock, [this] { return isStopping_ || hasWork(); });
        if (isStopping_) return;
        tryToPrepareSpare(lock);
    }
}

void PluginRuns::tryToPrepareSpare(std::unique_lock<std::mutex>& lock) noexcept {
    try {
        prepareSpare(lock);
    } catch (const std::exception& error) {
        if (!lock.owns_lock()) lock.lock();
        canBuild_ = false;
        errorText_ = std::string{"no scene run could be made: "} + error.what();
    }
}

// Makes a spare run if one is needed, and frees unused ones; `lock` (of mutex_) is unlocked meanwhile.
void PluginRuns::prepareSpare(std::unique_lock<std::mutex>& lock) {
    const auto spec = spec_;
    const bool isNeeded = isSpareNeeded();
    auto ended = collectUnused();
    lock.unlock();
    auto spare = isNeeded ? reuseOrBuild(ended, spec) : nullptr;
    ended.clear();
    lock.lock();
    if (!spare) return;
    spare->send(strips_);
    runs_.push_back(std::move(spare));
    PluginRun* const added = runs_.back().get();
    PluginRun* expected = nullptr;
    if (added->generation() != spec_->generation ||
        !spareRun_.compare_exchange_strong(expected, added, std::memory_order_acq_rel))
        added->isReleased = true;
}

std::unique_ptr<PluginRun> PluginRuns::reuseOrBuild(std::vector<std::unique_ptr<PluginRun>>& ended,
                                                    std::shared_ptr<const RunSpec> spec) {
    const auto found =
        std::ranges::find_if(ended, [&](const auto& run) { return run->generation() == spec->generation; });
    if (found == ended.end()) {
        ++builtRuns_;
        return makeRun(std::move(spec), sampleRateHz_, blockFrames_);
    }
    (*found)->rewind(timing());
    return std::move(*found);
}

bool PluginRuns::isDisposable(const PluginRun& run) const {
    return run.isReleased.load(std::memory_order_acquire) &&
           (run.generation() != spec_->generation || !followsHost(*spec_) || runs_.size() > maxRuns);
}

// True if no run is ready and either an ended one can be reused or there is room for another.
bool PluginRuns::isSpareNeeded() const {
    if (!followsHost(*spec_) || spareRun_.load() != nullptr || !canBuild_) return false;
    const bool hasEnded = std::ranges::any_of(
        runs_, [](const auto& run) { return run->isReleased.load(std::memory_order_acquire); });
    return hasEnded || !hasNextRun_ || runs_.size() < maxRuns;
}

bool PluginRuns::hasWork() const {
    return isSpareNeeded() ||
           std::ranges::any_of(runs_, [this](const auto& run) { return isDisposable(*run); });
}

// Removes and returns runs to be freed and, if one is needed, a run to be reused. mutex_ must be locked.
std::vector<std::unique_ptr<PluginRun>> PluginRuns::collectUnused() {
    std::vector<std::unique_ptr<PluginRun>> unused;
    bool isNeeded = isSpareNeeded();
    for (auto& run : runs_) {
        const bool isNext = isNeeded && run->isReleased && run->generation() == spec_->generation;
        if (!isNext && !isDisposable(*run)) continue;
        isNeeded = isNeeded && !isNext;
        logPlayed(*run);
        unused.push_back(std::move(run));
    }
    std::erase(runs_, nullptr);
    return unused;
}

void PluginRuns::logPlayed(PluginRun& run) {
    for (PlayedEvent played; run.session.played().pop(played);) {
        if (eventLog_.size() == maxLogEvents)
            eventLog_.erase(eventLog_.begin(), eventLog_.begin() + maxLogEvents / 2);
        eventLog_.push_back({run.number, played, run.loggedEventCount++, run.generation()});
    }
}

std::vector<RunEvent> PluginRuns::drainLog() {
    const std::lock_guard lock{mutex_};
    for (auto& run : runs_) logPlayed(*run);
    return std::exchange(eventLog_, {});
}

std::string PluginRuns::errorText() const {
    const std::lock_guard lock{mutex_};
    for (const auto& run : runs_)
        if (run->session.world().hasFailed() && !run->isReleased)
            return "the world stands still: a step of it failed";
    return errorText_;
}

std::int64_t PluginRuns::readPoses(std::vector<BodyPose>& poses) {
    const std::lock_guard lock{mutex_};
    const PluginRun* newest = nullptr;
    for (const auto& run : runs_)
        if (!run->isReleased && run->number > 0 && (!newest || run->number > newest->number))
            newest = run.get();
    poses.clear();
    return newest ? newest->session.world().readPoses(poses) : 0;
}

// The render thread's part. Nothing here allocates, locks or waits, except in blocks for which the render
// call steps the world itself.

template <class Visit>
void PluginRuns::forEachAudible(Visit visit) const noexcept {
    if (current_) visit(*current_);
    for (std::size_t i = endingCount_; i-- > 0;) visit(*ending_[i]);
}

TransportMode PluginRuns::adoptNewSettings() noexcept {
    if (nextRun_ && nextRun_->generation() == newestGeneration_.load(std::memory_order_acquire))
        return newSettings_.transport;
    PluginRun* const newRun = spareRun_.exchange(nullptr, std::memory_order_acq_rel);
    if (!newRun) return newSettings_.transport;
    retire(nextRun_);
    nextRun_ = newRun;
    hasNextRun_ = true;
    newSettings_ = nextRun_->settings();
    if (current_ && current_->generation() != nextRun_->generation()) isStartRequested_ = true;
    return newSettings_.transport;
}

bool PluginRuns::begin(RenderMode mode) noexcept {
    retireFinished();
    adoptNewSettings();
    if (!isStartRequested_) return false;
    if (!nextRun_ && mode == RenderMode::offline) {
        std::unique_lock lock{mutex_};
        tryToPrepareSpare(lock);
        adoptNewSettings();
    }
    if (nextRun_) stop();
    if (!nextRun_ || current_) {
        isStartRequested_ = true;
        ++delayedBlocks_;
        return false;
    }
    current_ = std::exchange(nextRun_, nullptr);
    hasNextRun_ = false;
    current_->number = ++startedRuns_;
    return true;
}

void PluginRuns::stop() noexcept {
    isStartRequested_ = false;
    if (!current_ || endingCount_ == ending_.size()) return;
    endedLateEvents_ += current_->session.status().render.late;
    endedStalledNs_ += current_->session.world().stalledNs();
    current_->end();
    ending_[endingCount_++] = std::exchange(current_, nullptr);
}

bool PluginRuns::silence(int frame) noexcept {
    bool isDone = true;
    forEachAudible([&](PluginRun& run) { isDone = run.silence(frame) && isDone; });
    return isDone;
}

void PluginRuns::retire(PluginRun*& run) noexcept {
    if (run) run->isReleased.store(true, std::memory_order_release);
    run = nullptr;
}

void PluginRuns::retireFinished() noexcept {
    const auto finished = std::ranges::remove_if(std::span{ending_}.first(endingCount_), [](PluginRun* run) {
        const bool hasFaded = run->hasFaded();
        if (hasFaded) retire(run);
        return hasFaded;
    });
    endingCount_ -= finished.size();
}

void PluginRuns::render(int frames, RenderMode mode) noexcept {
    blocks_.fetch_add(1, std::memory_order_relaxed);
    forEachAudible([&](PluginRun& run) { run.render(frames, timing(), renderModeFor(run, frames, mode)); });
    if (current_) writeStatus();
}

// The render call steps the world if timing is tight or the host asks for frames that the stepping thread has
// not reached. A world slower than real time then delays a live host; the samples are the same.
RenderMode PluginRuns::renderModeFor(const PluginRun& run, int frames, RenderMode requested) noexcept {
    if (requested == RenderMode::offline) return requested;
    if (timing() == StepTiming::tight) return RenderMode::offline;
    if (run.session.framesMissing(frames) <= 0) return requested;
    ++steppedBlocks_;
    return RenderMode::offline;
}

void PluginRuns::writeStatus() noexcept {
    const auto& now = current_->session.status();
    status_.write({now, current_->number, endedLateEvents_ + now.render.late,
                   endedStalledNs_ + current_->session.world().stalledNs(), delayedBlocks_, steppedBlocks_});
}

int PluginRuns::channels() const noexcept {
    int count = 0;
    forEachAudible([&](const PluginRun& run) { count = std::max(count, run.session.channels()); });
    return count;
}

void PluginRuns::addTo(float* out, int channel, int frames) const noexcept {
    forEachAudible([=](const PluginRun& run) {
        if (channel >= run.session.channels()) return;
        const float* const in = run.samples[static_cast<std::size_t>(channel)].data();
        std::transform(in, in + frames, out, out, [](float a, float b) { return a + b; });
    });
}

// The lowest realtime priority: below audio, above all else. Where that is not allowed, the highest normal
// one.
Stepper::Stepper()
    : Thread{"PhysVib worlds"} {
#if JUCE_MAJOR_VERSION >= 8
    const auto lowest = RealtimeOptions{}.withPriority(1);
#else
    const RealtimeOptions lowest{1, 0};
#endif
    if (!startRealtimeThread(lowest)) startThread(Priority::highest);
}

Stepper::~Stepper() {
    signalThreadShouldExit();
    { const std::lock_guard lock{mutex_}; } // otherwise the thread could miss the notification
    wakeCondition_.notify_all();
    stopThread(-1);
}

void Stepper::add(StepClient& client) {
    {
        const std::lock_guard lock{mutex_};
        members_.push_back({&client, client.blocks(), Clock::now(), {}});
    }
    wakeCondition_.notify_all();
}

void Stepper::remove(StepClient& client) {
    const std::lock_guard lock{mutex_};
    std::erase_if(members_, [&](const Member& member) { return member.client == &client; });
}

// Ticks a member whose time has come. The next tick is at a multiple of its period: members of equal period
// then share one waking, and none catches up by a burst of ticks after a stall.
void Stepper::tick(Member& member, Clock::time_point now) {
    if (now < member.nextTick) return;
    member.client->tick();
    if (const auto blocks = member.client->blocks(); blocks != member.blocks) {
        member.blocks = blocks;
        member.lastBlock = now;
    }
    const double seconds = now - member.lastBlock > idleAfter ? member.client->idleSeconds()
                                                              : 1.0 / member.client->ticksPerSecond();
    const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{seconds});
    member.nextTick = Clock::time_point{(now.time_since_epoch() / period + 1) * period};
}

void Stepper::run() {
    std::unique_lock lock{mutex_};
    while (!threadShouldExit()) {
        const auto now = Clock::now();
        auto next = Clock::time_point::max();
        for (Member& member : members_) {
            tick(member, now);
            next = std::min(next, member.nextTick);
        }
        if (members_.empty())
            wakeCondition_.wait(lock);
        else
            wakeCondition_.wait_until(lock, next);
        wakeUps_.fetch_add(1, std::memory_order_relaxed);
    }
}

} // namespace physvib
