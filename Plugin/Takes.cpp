// SPDX-License-Identifier: GPL-3.0-or-later
// Creates, steps and frees scene runs: everything except the render thread's part.
#include "Takes.h"
#include "Scene/SceneLimits.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/InputCheck.h"
#include <algorithm>
#include <stdexcept>
#include <utility>

namespace physvib {
namespace {

// As many groups as a scene may have inputs at one look, since each look goes through all bodies: there may
// be a hundred. Those that are wrong, or too much together, are looked at one by one.
void checkGroups(const SessionSetup& setup) {
    const auto require = [](const std::string& fault) {
        if (!fault.empty()) throw std::invalid_argument(fault);
    };
    require(validate(setup.scene));
    std::vector<Action> together;
    std::size_t first = 0;
    const auto check = [&](std::size_t end) {
        if (!InputCheck{setup.scene}.take(together).empty())
            for (std::size_t i = first; i < end; ++i) require(InputCheck{setup.scene}.take(setup.groups[i]));
        together.clear();
        first = end;
    };
    for (std::size_t i = 0; i < setup.groups.size(); ++i) {
        const auto& group = setup.groups[i];
        if (setup.scene.inputs.size() + together.size() + group.size() > sceneLimits::maxInputs) check(i);
        together.insert(together.end(), group.begin(), group.end());
    }
    check(setup.groups.size());
}

bool startsQuickly(const TakeSpec& order) noexcept { return order.settings.transport != TransportMode::free; }

} // namespace

void Takes::set(SessionSetup setup, const TakeSettings& settings, std::vector<Strip> strips) {
    checkGroups(setup);
    const std::lock_guard one{setMutex_};
    const auto before = [this] {
        const std::lock_guard lock{mutex_};
        return order_;
    }();
    for (;;) { // a take is built without the mutex, so that the worlds that play are stepped meanwhile
        std::unique_lock lock{mutex_};
        const int rate = sampleRateHz_, block = blockFrames_;
        const double known = knownAfterSeconds_;
        TakeSpec order{setup, settings, before ? before->generation + 1 : 1};
        setGaps(order);
        lock.unlock();
        const auto wanted = std::make_shared<const TakeSpec>(std::move(order));
        std::unique_ptr<Take> take;
        if (block > 0)
            take = newTake(wanted, rate, block);
        else // throws if it cannot be simulated
            Simulation{wanted->setup.scene, wanted->setup.seed, wanted->setup.stepsPerSecond};
        lock.lock();
        // the host has prepared us meanwhile
        if (rate != sampleRateHz_ || block != blockFrames_ || known != knownAfterSeconds_) continue;
        strips_ = std::move(strips);
        return exchange(wanted, std::move(take));
    }
}

void Takes::mix(std::vector<Strip> strips) {
    const std::lock_guard lock{mutex_};
    strips_ = std::move(strips);
    sendAll();
}

// The mutex is held. What found no room is sent again by the next tick.
void Takes::sendAll() {
    for (auto& take : takes_)
        if (take->generation() == order_->generation && !take->isEnded.load(std::memory_order_acquire))
            take->send(strips_);
}

// The mutex is held.
void Takes::exchange(std::shared_ptr<const TakeSpec> order, std::unique_ptr<Take> take) {
    order_ = std::move(order);
    fault_.clear();
    canMake_ = true;
    if (!take) return;
    take->send(strips_);
    const auto& setup = order_->setup;
    ticksPerSecond_ =
        setup.hasWorld ? TakePace::ticksPerSecond(setup.stepsPerSecond) : TakePace::stillTicksPerSecond;
    idleSeconds_ = setup.hasWorld ? TakePace::idleSeconds(setup.stepsPerSecond) : TakePace::stillIdleSeconds;
    safeFrames_ = take->latencyFrames(TakeTiming::safe);
    tightFrames_ = take->latencyFrames(TakeTiming::tight);
    directFrames_ = setup.direct == Direct::fromStart ? take->session.timeline().inputLatencyFrames() : 0;
    takes_.push_back(std::move(take));
    Take* const unused = spare_.exchange(takes_.back().get(), std::memory_order_acq_rel);
    if (unused) unused->isEnded = true;
    newest_.store(order_->generation, std::memory_order_release);
}

// With a world, what is known late has, beside the gap, the two steps that L has room for. The mutex is held.
void Takes::setGaps(TakeSpec& order) const noexcept {
    auto& setup = order.setup;
    const double known = order.knownAfterSeconds = setup.direct == Direct::no ? knownAfterSeconds_ : 0.0;
    setup.longestGapSeconds = setup.hasWorld ? std::max(TakePace::longestGapSeconds(setup.stepsPerSecond),
                                                        known - 2.0 / setup.stepsPerSecond)
                                             : known;
}

std::unique_ptr<Take> Takes::newTake(std::shared_ptr<const TakeSpec> order, int sampleRateHz,
                                     int blockFrames) const {
    return std::make_unique<Take>(std::move(order), sampleRateHz, blockFrames, timing(), hasMusic_);
}

void Takes::prepare(int sampleRateHz, int blockFrames, double knownAfterSeconds, bool hasMusic) {
    release();
    std::unique_lock lock{mutex_};
    knownAfterSeconds_ = knownAfterSeconds;
    hasMusic_ = hasMusic;
    if (!order_) return;
    auto order = *order_;
    setGaps(order);
    order_ = std::make_shared<const TakeSpec>(std::move(order));
    sampleRateHz_ = sampleRateHz;
    blockFrames_ = blockFrames;
    started_ = 0;
    delayedBlocks_ = lateBefore_ = 0;
    slippedBefore_ = 0;
    aheadBlocks_ = 0;
    startWanted_ = false;
    status_.write({});
    exchange(order_, newTake(order_, sampleRateHz, blockFrames));
    stop_ = false;
    if (isDrivenByHand_) return;
    builder_ = std::thread{[this] { build(); }};
    lock.unlock(); // who steps holds its own mutex first
    stepper_.emplace();
    (*stepper_)->add(*this);
}

void Takes::release() {
    stop_ = true; // first: who steps holds the mutex, and ends within a step
    if (stepper_) {
        (*stepper_)->remove(*this);
        stepper_.reset();
    }
    { const std::lock_guard lock{mutex_}; } // or the builder would sleep through it
    workToDo_.notify_all();
    if (builder_.joinable()) builder_.join();
    const std::lock_guard lock{mutex_};
    for (auto& take : takes_) drain(*take);
    playing_ = next_ = nullptr;
    endingCount_ = 0;
    spare_ = nullptr;
    hasNext_ = false;
    takes_.clear();
    sampleRateHz_ = blockFrames_ = 0;
}

void Takes::tick() {
    std::unique_lock lock{mutex_};
    sendAll();
    for (auto& take : takes_) {
        if (take->isEnded.load(std::memory_order_acquire)) continue;
        stepWorld(*take);
        drain(*take);
    }
    if (!isWorkToDo()) return;
    if (isDrivenByHand_) return tryToMakeReady(lock);
    lock.unlock();
    workToDo_.notify_one();
}

// Out of memory, at worst: the host plays on.
void Takes::stepWorld(Take& take) {
    if (take.isStill) return;
    try {
        // release() waits for one step of a heavy world, not for all
        take.session.advance([this](auto) { return !stop_; });
    } catch (const std::exception& error) {
        take.isStill = true;
        fault_ = std::string{"the world stands still: "} + error.what();
    }
}

void Takes::build() {
    std::unique_lock lock{mutex_};
    for (;;) {
        workToDo_.wait(lock, [this] { return stop_ || isWorkToDo(); });
        if (stop_) return;
        tryToMakeReady(lock);
    }
}

void Takes::tryToMakeReady(std::unique_lock<std::mutex>& lock) noexcept {
    try {
        makeReady(lock);
    } catch (const std::exception& error) {
        if (!lock.owns_lock()) lock.lock();
        canMake_ = false;
        fault_ = std::string{"no scene run could be made: "} + error.what();
    }
}

// The mutex is held, but not while a take is made or freed.
void Takes::makeReady(std::unique_lock<std::mutex>& lock) {
    const auto order = order_;
    const bool isNeeded = isTakeNeeded();
    auto ended = collectUnused();
    lock.unlock();
    auto ready = isNeeded ? makeOf(ended, order) : nullptr;
    ended.clear();
    lock.lock();
    if (!ready) return;
    ready->send(strips_);
    takes_.push_back(std::move(ready));
    Take* const made = takes_.back().get();
    Take* none = nullptr;
    if (made->generation() != order_->generation ||
        !spare_.compare_exchange_strong(none, made, std::memory_order_acq_rel))
        made->isEnded = true;
}

std::unique_ptr<Take> Takes::makeOf(std::vector<std::unique_ptr<Take>>& ended,
                                    std::shared_ptr<const TakeSpec> order) {
    const auto found = std::ranges::find_if(
        ended, [&](const auto& take) { return take->generation() == order->generation && !take->isStill; });
    if (found == ended.end()) {
        ++made_;
        return newTake(std::move(order), sampleRateHz_, blockFrames_);
    }
    (*found)->rewind(timing());
    return std::move(*found);
}

bool Takes::isLeftOver(const Take& take) const {
    return take.isEnded.load(std::memory_order_acquire) &&
           (take.generation() != order_->generation || !startsQuickly(*order_) || takes_.size() > kept);
}

// One more is worth its memory if none is ready; else what is ending will do.
bool Takes::isTakeNeeded() const {
    if (!startsQuickly(*order_) || spare_.load() != nullptr || !canMake_) return false;
    const bool hasEnded = std::ranges::any_of(
        takes_, [](const auto& take) { return take->isEnded.load(std::memory_order_acquire); });
    return hasEnded || !hasNext_ || takes_.size() < kept;
}

bool Takes::isWorkToDo() const {
    return isTakeNeeded() ||
           std::ranges::any_of(takes_, [this](const auto& take) { return isLeftOver(*take); });
}

// Those left over, and if one is needed, one that has ended. The mutex is held.
std::vector<std::unique_ptr<Take>> Takes::collectUnused() {
    std::vector<std::unique_ptr<Take>> out;
    bool isNeeded = isTakeNeeded();
    for (auto& take : takes_) {
        const bool isNext = isNeeded && take->isEnded && take->generation() == order_->generation;
        if (!isNext && !isLeftOver(*take)) continue;
        isNeeded = isNeeded && !isNext;
        drain(*take);
        out.push_back(std::move(take));
    }
    std::erase(takes_, nullptr);
    return out;
}

void Takes::drain(Take& take) {
    for (PlayedEvent played; take.session.played().pop(played);) {
        if (log_.size() == logSize) log_.erase(log_.begin(), log_.begin() + logSize / 2);
        log_.push_back({take.number, played, take.logged++});
    }
}

std::vector<TakeEvent> Takes::drainLog() {
    const std::lock_guard lock{mutex_};
    for (auto& take : takes_) drain(*take);
    return std::exchange(log_, {});
}

std::string Takes::fault() const {
    const std::lock_guard lock{mutex_};
    return fault_;
}

std::int64_t Takes::poses(std::vector<BodyPose>& now) {
    const std::lock_guard lock{mutex_};
    const Take* newest = nullptr;
    for (const auto& take : takes_)
        if (!take->isEnded && take->number > 0 && (!newest || take->number > newest->number))
            newest = take.get();
    now.clear();
    return newest ? newest->session.world().readPoses(now) : 0;
}

// The render thread's part of scene runs: nothing here allocates, locks or waits, except where a block needs
// the world to be stepped in the render call.

template <class Do>
void Takes::forEachSounding(Do what) const noexcept {
    if (playing_) what(*playing_);
    for (std::size_t i = endingCount_; i-- > 0;) what(*ending_[i]);
}

TransportMode Takes::lookForNew() noexcept {
    if (next_ && next_->generation() == newest_.load(std::memory_order_acquire))
        return newSettings_.transport;
    Take* const fresh = spare_.exchange(nullptr, std::memory_order_acq_rel);
    if (!fresh) return newSettings_.transport;
    letGo(next_);
    next_ = fresh;
    hasNext_ = true;
    newSettings_ = next_->settings();
    if (playing_ && playing_->generation() != next_->generation()) startWanted_ = true;
    return newSettings_.transport;
}

bool Takes::begin(RenderMode mode) noexcept {
    letGoOfThoseOver();
    lookForNew();
    if (!startWanted_) return false;
    if (!next_ && mode == RenderMode::offline) {
        std::unique_lock lock{mutex_};
        tryToMakeReady(lock);
        lookForNew();
    }
    if (next_) stop();
    if (!next_ || playing_) {
        startWanted_ = true;
        ++delayedBlocks_;
        return false;
    }
    playing_ = std::exchange(next_, nullptr);
    hasNext_ = false;
    playing_->number = ++started_;
    return true;
}

void Takes::stop() noexcept {
    startWanted_ = false;
    if (!playing_ || endingCount_ == ending_.size()) return;
    lateBefore_ += playing_->session.status().render.late;
    slippedBefore_ += playing_->session.world().slippedNs();
    playing_->end();
    ending_[endingCount_++] = std::exchange(playing_, nullptr);
}

bool Takes::silence(int frame) noexcept {
    bool all = true;
    forEachSounding([&](Take& take) { all = take.silence(frame) && all; });
    return all;
}

void Takes::letGo(Take*& take) noexcept {
    if (take) take->isEnded.store(true, std::memory_order_release);
    take = nullptr;
}

void Takes::letGoOfThoseOver() noexcept {
    const auto rest = std::ranges::remove_if(std::span{ending_}.first(endingCount_), [](Take* take) {
        const bool isOver = take->isOver();
        if (isOver) letGo(take);
        return isOver;
    });
    endingCount_ -= rest.size();
}

void Takes::render(int frames, RenderMode mode) noexcept {
    blocks_.fetch_add(1, std::memory_order_relaxed);
    forEachSounding([&](Take& take) { take.render(frames, timing(), modeFor(take, frames, mode)); });
    if (playing_) writeStatus();
}

// In tight timing, and where the host asks for frames ahead of the stepping thread. A world that takes longer
// than real time holds a live host up, as any plug-in does that is too much; the samples are the same.
RenderMode Takes::modeFor(const Take& take, int frames, RenderMode asked) noexcept {
    if (asked == RenderMode::offline) return asked;
    if (timing() == TakeTiming::tight) return RenderMode::offline;
    if (take.session.framesMissing(frames) <= 0) return asked;
    ++aheadBlocks_;
    return RenderMode::offline;
}

void Takes::writeStatus() noexcept {
    const auto& now = playing_->session.status();
    status_.write({now, playing_->number, lateBefore_ + now.render.late,
                   slippedBefore_ + playing_->session.world().slippedNs(), delayedBlocks_, aheadBlocks_});
}

int Takes::channels() const noexcept {
    int most = 0;
    forEachSounding([&](const Take& take) { most = std::max(most, take.session.channels()); });
    return most;
}

void Takes::addTo(float* out, int channel, int frames) const noexcept {
    forEachSounding([=](const Take& take) {
        if (channel >= take.session.channels()) return;
        const float* const in = take.out[static_cast<std::size_t>(channel)].data();
        std::transform(in, in + frames, out, out, [](float a, float b) { return a + b; });
    });
}

// Schedules the worlds by deadline; the thread sleeps until the first one.

// Above all that is not audio, below what is: few users are allowed that.
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
    wake();
    stopThread(-1);
}

void Stepper::wake() {
    { const std::lock_guard lock{mutex_}; } // or it would sleep through it
    changed_.notify_all();
}

void Stepper::add(Stepped& one) {
    {
        const std::lock_guard lock{mutex_};
        members_.push_back({&one, one.blocks(), Clock::now(), {}});
    }
    changed_.notify_all();
}

void Stepper::remove(Stepped& one) {
    const std::lock_guard lock{mutex_};
    std::erase_if(members_, [&](const Member& member) { return member.one == &one; });
}

// At multiples of its period: equal ones come in one waking, and none comes in a burst after a stall.
void Stepper::tick(Member& member, Clock::time_point now) {
    if (now < member.next) return;
    member.one->tick();
    if (const auto blocks = member.one->blocks(); blocks != member.blocks) {
        member.blocks = blocks;
        member.lastBlock = now;
    }
    const double seconds =
        now - member.lastBlock > restsAfter ? member.one->idleSeconds() : 1.0 / member.one->ticksPerSecond();
    const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{seconds});
    member.next = Clock::time_point{(now.time_since_epoch() / period + 1) * period};
}

void Stepper::run() {
    std::unique_lock lock{mutex_};
    while (!threadShouldExit()) {
        const auto now = Clock::now();
        auto next = Clock::time_point::max();
        for (Member& member : members_) {
            tick(member, now);
            next = std::min(next, member.next);
        }
        if (members_.empty())
            changed_.wait(lock);
        else
            changed_.wait_until(lock, next);
        wakeUps_.fetch_add(1, std::memory_order_relaxed);
    }
}

} // namespace physvib
