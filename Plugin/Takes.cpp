// SPDX-License-Identifier: GPL-3.0-or-later
// Starting, ending and recycling takes.
#include "Takes.h"
#include "Physics/InputCheck.h"
#include "Physics/SceneValidation.h"
#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace physvib {

Take::Take(const SessionSetup& setup, std::uint64_t ofGeneration, int sampleRateHz, int blockFrames)
    : session{setup}
    , generation{ofGeneration}
    , sampleRateHz_{sampleRateHz}
    , blockFrames_{blockFrames} {
    out.assign(static_cast<std::size_t>(session.channels()), std::vector<float>(static_cast<std::size_t>(blockFrames)));
    for (auto& channel : out) at_.push_back(channel.data());
    rewind();
}

void Take::rewind() {
    session.prepare(sampleRateHz_, blockFrames_);
    session.advance(); // its time begins with the first block
    fade_.prepare(sampleRateHz_, limits::channelRampSeconds, 1.0f);
    owed_ = -1;
    over_ = false;
    number = 0;
    isEnded = false;
}

void Take::end() noexcept {
    if (owed_ < 0) owed_ = session.playOutFrames();
}

void Take::render(int frames, RenderMode mode) noexcept {
    session.render(at_.data(), frames, mode);
    if (owed_ < 0) return;
    const int kept = static_cast<int>(std::min<std::int64_t>(owed_, frames));
    owed_ -= kept;
    if (kept == frames) return;
    std::array<float*, limits::maxEnchanters> rest{};
    for (std::size_t j = 0; j < at_.size(); ++j) rest[j] = at_[j] + kept;
    fade_.moveTo(0.0f);
    fade_.apply(rest.data(), session.channels(), frames - kept);
    over_ = fade_.isResting();
}

// Any thread but R

namespace {

void checkGroups(const SessionSetup& setup) {
    if (std::string fault = validate(setup.scene); !fault.empty()) throw std::invalid_argument(fault);
    for (const auto& group : setup.groups) {
        InputCheck check{setup.scene};
        for (const Action& action : group)
            if (std::string fault = check.take(action); !fault.empty()) throw std::invalid_argument(fault);
    }
}

} // namespace

void Takes::set(SessionSetup setup) {
    setup.longestGapSeconds = TakePace::longestGapSeconds(setup.stepsPerSecond);
    checkGroups(setup);
    const std::lock_guard one{setMutex_};
    for (;;) { // a take is built without the mutex, so that the worlds that play are stepped meanwhile
        auto [rate, block, generation] = present();
        std::unique_ptr<Take> take;
        if (block > 0) take = std::make_unique<Take>(setup, generation + 1, rate, block);
        else Simulation{setup.scene, setup.seed, setup.stepsPerSecond}; // throws if it cannot be simulated
        const std::lock_guard lock{mutex_};
        if (rate != sampleRateHz_ || block != blockFrames_) continue; // the host has prepared us meanwhile
        setup_ = std::move(setup);
        if (take) exchange(std::move(take));
        return;
    }
}

std::tuple<int, int, std::uint64_t> Takes::present() {
    const std::lock_guard lock{mutex_};
    return {sampleRateHz_, blockFrames_, generation_};
}

// The mutex is held.
void Takes::exchange(std::unique_ptr<Take> take) {
    generation_ = take->generation;
    ticksPerSecond_ = TakePace::ticksPerSecond(setup_->stepsPerSecond);
    playOutFrames_ = take->session.playOutFrames();
    takes_.push_back(std::move(take));
    Take* const unused = spare_.exchange(takes_.back().get(), std::memory_order_acq_rel);
    if (unused) unused->isEnded = true;
    renew_.store(true, std::memory_order_release);
}

void Takes::prepare(int sampleRateHz, int blockFrames) {
    release();
    const std::lock_guard lock{mutex_};
    if (!setup_) return;
    sampleRateHz_ = sampleRateHz;
    blockFrames_ = blockFrames;
    ticksPerSecond_ = TakePace::ticksPerSecond(setup_->stepsPerSecond);
    started_ = 0;
    delayedBlocks_ = lateBefore_ = 0;
    slippedBefore_ = 0;
    startWanted_ = false;
    renew_ = false;
    status_.write({});
    spare_ = &add();
    playOutFrames_ = takes_.back()->session.playOutFrames();
    stop_ = false;
    thread_ = std::thread{[this] { run(); }};
}

void Takes::release() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    const std::lock_guard lock{mutex_};
    for (auto& take : takes_) drain(*take);
    playing_ = ending_ = nullptr;
    spare_ = nullptr;
    takes_.clear();
    sampleRateHz_ = blockFrames_ = 0;
}

Take& Takes::add() {
    takes_.push_back(std::make_unique<Take>(*setup_, generation_, sampleRateHz_, blockFrames_));
    return *takes_.back();
}

void Takes::run() {
    using Clock = std::chrono::steady_clock;
    for (auto deadline = Clock::now(); !stop_;) {
        const std::chrono::nanoseconds period{1'000'000'000 / ticksPerSecond_};
        deadline += period;
        if (const auto now = Clock::now(); now > deadline + 10 * period) deadline = now; // after a stall: no burst of ticks
        std::this_thread::sleep_until(deadline);
        tick();
    }
}

void Takes::tick() {
    const std::lock_guard lock{mutex_};
    for (auto& take : takes_) {
        if (take->isEnded.load(std::memory_order_acquire)) continue;
        take->session.advance();
        drain(*take);
    }
    makeReady();
}

// Ended takes of the present setup become the spare, others go; without one, a new one is made if starts must be quick.
void Takes::makeReady() {
    const auto isOver = [this](auto& take) {
        if (!take->isEnded.load(std::memory_order_acquire)) return false;
        drain(*take);
        if (take->generation != generation_ || !quickStarts_ || spare_.load() != nullptr) return true;
        take->rewind();
        spare_.store(take.get(), std::memory_order_release);
        return false;
    };
    std::erase_if(takes_, isOver);
    if (quickStarts_ && spare_.load() == nullptr && takes_.size() < 3) spare_.store(&add(), std::memory_order_release);
}

void Takes::drain(Take& take) {
    for (PlayedEvent played; take.session.played().pop(played);) {
        if (log_.size() < logSize) log_.push_back({take.number, played});
        else ++lost_;
    }
}

std::vector<TakeEvent> Takes::takeLog() {
    const std::lock_guard lock{mutex_};
    for (auto& take : takes_) drain(*take);
    return std::exchange(log_, {});
}

std::int64_t Takes::poses(std::vector<BodyPose>& now) {
    const std::lock_guard lock{mutex_};
    const Take* newest = nullptr;
    for (const auto& take : takes_)
        if (!take->isEnded && take->number > 0 && (!newest || take->number > newest->number)) newest = take.get();
    now.clear();
    return newest ? newest->session.readPoses(now) : 0;
}

// R

bool Takes::begin(RenderMode mode) noexcept {
    if (ending_ && ending_->isOver()) letGo(ending_);
    if (renew_.exchange(false, std::memory_order_acq_rel) && playing_) startWanted_ = true;
    if (!startWanted_) return false;
    Take* const next = takeSpare(mode);
    if (!next) {
        ++delayedBlocks_;
        return false;
    }
    stop();
    playing_ = next;
    next->number = ++started_;
    return true;
}

Take* Takes::takeSpare(RenderMode mode) noexcept {
    Take* const ready = spare_.exchange(nullptr, std::memory_order_acq_rel);
    if (ready || mode == RenderMode::realtime) return ready;
    const std::lock_guard lock{mutex_};
    makeReady();
    Take* const next = spare_.exchange(nullptr);
    return next ? next : &add();
}

void Takes::stop() noexcept {
    startWanted_ = false;
    if (!playing_) return;
    letGo(ending_);
    lateBefore_ += playing_->session.status().render.late;
    slippedBefore_ += playing_->session.slippedNs();
    ending_ = playing_;
    ending_->end();
    playing_ = nullptr;
}

void Takes::letGo(Take*& take) noexcept {
    if (take) take->isEnded.store(true, std::memory_order_release);
    take = nullptr;
}

void Takes::render(int frames, RenderMode mode) noexcept {
    if (playing_) {
        playing_->render(frames, mode);
        const auto& now = playing_->session.status();
        status_.write({now, playing_->number, lateBefore_ + now.render.late, slippedBefore_ + playing_->session.slippedNs(), delayedBlocks_});
    }
    if (ending_ && !ending_->isOver()) ending_->render(frames, mode);
}

void Takes::addTo(float* out, int channel, int frames) const noexcept {
    for (const Take* take : {static_cast<const Take*>(playing_), static_cast<const Take*>(ending_)}) {
        if (channel >= channelsOf(take)) continue;
        const float* const in = take->out[static_cast<std::size_t>(channel)].data();
        std::transform(in, in + frames, out, out, [](float a, float b) { return a + b; });
    }
}

} // namespace physvib
