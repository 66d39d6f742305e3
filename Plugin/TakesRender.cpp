// SPDX-License-Identifier: GPL-3.0-or-later
// The render thread's part of scene runs: nothing here allocates, locks or waits, except in non-realtime
// blocks.
#include "Takes.h"
#include <algorithm>
#include <cmath>

namespace physvib {

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
    playing_->session.startLater(leadFrames_ - playing_->leadFrames()); // what the host asked for meanwhile
    playing_->number = ++started_;
    // it may have been made for more
    playOutFrames_ = playing_->session.timeline().playOutFrames() -
                     std::max<std::int64_t>(0, playing_->leadFrames() - leadFrames_);
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
    for (std::size_t i = 0; i < endingCount_;) {
        if (!ending_[i]->isOver()) {
            ++i;
            continue;
        }
        letGo(ending_[i]);
        std::copy(ending_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                  ending_.begin() + static_cast<std::ptrdiff_t>(endingCount_),
                  ending_.begin() + static_cast<std::ptrdiff_t>(i));
        --endingCount_;
    }
}

void Takes::render(int frames, RenderMode mode) noexcept {
    blocks_.fetch_add(1, std::memory_order_relaxed);
    if (mode == RenderMode::realtime) coverBurst(frames);
    const std::int64_t lead = leadFrames_;
    forEachSounding([=](Take& take) { take.render(frames, lead, mode); });
    if (playing_) tell();
}

// L grows if the world is not where the next frames need it though it has been stepped in time. If the thread
// itself was late, more delay would not mend that: the world stands still for as long, as always. So it does
// for a host that was late for once.
void Takes::coverBurst(int frames) noexcept {
    const std::int64_t now = nowNs(), lead = leadFrames_;
    hostPace_.ask(frames, now, sampleRateHz_);
    runFrames_ += frames;
    std::int64_t needed = 0;
    bool isGrowing = false;
    forEachSounding([&](Take& take) {
        needed = std::max(needed, take.leadFrames() + take.session.framesMissing(frames));
        isGrowing = isGrowing || take.leadFrames() < lead;
    });
    if (needed > blockFrames_) {
        neededNs_ = now;
        isAheadNeeded_ = isAheadNeeded_ || aheadFrames_ > blockFrames_;
    }
    if (needed <= lead && !isGrowing) return heal(now);
    const double spareSeconds = 1.0 / ticksPerSecond_ + TakePace::headroomSeconds -
                                1e-9 * static_cast<double>(now - tickedNs_.load(std::memory_order_acquire));
    if (!isGrowing && spareSeconds < 0.0) return;
    const bool goesAhead = hostPace_.goesAhead();
    if (needed > lead && !goesAhead && !hostPace_.stuttersAgain(now) && !isGrowing) return;
    // the thread may come so much later the next time
    needed += static_cast<std::int64_t>(std::max(0.0, spareSeconds) * sampleRateHz_);
    if (needed <= lead) return;
    const auto step = static_cast<std::int64_t>(TakePace::growthSeconds * sampleRateHz_);
    const auto most = std::max(lead, static_cast<std::int64_t>(TakePace::mostLeadSeconds * sampleRateHz_));
    this->lead(std::min(lead + (needed - lead + step - 1) / step * step, most));
    if (!goesAhead) return;
    isAheadNeeded_ = true;
    aheadFrames_ = leadFrames_;
    leadSeconds_ = static_cast<double>(aheadFrames_) / sampleRateHz_;
}

// What nobody has needed for a while: what stutters had made it, as soon as they are over; the rest, where
// the transport stands.
void Takes::heal(std::int64_t nowNs) noexcept {
    const bool isCalm = nowNs - neededNs_ > HostPace::calmNs;
    const bool all = giveBack_.exchange(false) || (isCalm && stands_);
    if (all) {
        aheadFrames_ = blockFrames_;
        leadSeconds_ = 0.0;
    }
    if ((all || isCalm) && leadFrames_ > aheadFrames_) lead(aheadFrames_);
}

// From now on; what is shorter by more than it has grown in this run was longer from its start.
void Takes::lead(std::int64_t frames) noexcept {
    const std::int64_t more = frames - leadFrames_;
    leadFrames_ = frames;
    playOutFrames_ += more;
    waitedFrames_ = std::max<std::int64_t>(0, waitedFrames_ + more);
}

void Takes::tell() noexcept {
    const auto& now = playing_->session.status();
    status_.write({now, playing_->number, lateBefore_ + now.render.late,
                   slippedBefore_ + playing_->session.world().slippedNs(), delayedBlocks_,
                   leadFrames_ - blockFrames_, waitedFrames_});
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

} // namespace physvib
