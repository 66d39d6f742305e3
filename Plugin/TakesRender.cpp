// SPDX-License-Identifier: GPL-3.0-or-later
// The render thread's part of scene runs: nothing here allocates, locks or waits, except where a block needs
// the world to be stepped in the render call.
#include "Takes.h"
#include <algorithm>

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
    forEachSounding([&](Take& take) { take.render(frames, timing(), modeFor(take, frames, mode)); });
    if (playing_) tell();
}

// The world is stepped in the render call where it has to be: in tight timing, and where the host asks for
// frames ahead of the thread that steps it, whatever the host says of itself. A live host whose world is in
// time never comes here. A world that takes longer than real time holds such a host up, as any plug-in does
// that is too much for the machine, and the host shows that; the samples are the same.
RenderMode Takes::modeFor(const Take& take, int frames, RenderMode told) noexcept {
    if (told == RenderMode::offline) return told;
    if (timing() == TakeTiming::tight) return RenderMode::offline;
    if (take.session.framesMissing(frames) <= 0) return told;
    ++aheadBlocks_;
    return RenderMode::offline;
}

void Takes::tell() noexcept {
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

} // namespace physvib
