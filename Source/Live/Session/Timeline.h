// SPDX-License-Identifier: MIT
// Session time in frames and in nanoseconds, and L, by which what is felt lies behind it.
#pragma once
#include "Core/ClockLaw.h"
#include "Core/FrameClock.h"
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>

namespace physvib {

/// Part of a session, which begins and ends it. R tells it; the law behind L changes while nobody renders,
/// under the mutexes of all parts.
class Timeline {
public:
    /// Session time. Any thread but R.
    std::int64_t presentNs() const {
        const std::lock_guard lock{mutex_};
        return nowNs();
    }

    /// L. Any thread but R.
    double playOutSeconds() const {
        const std::lock_guard lock{mutex_};
        return static_cast<double>(playOutFrames()) / law_.sampleRateHz;
    }

    /// Of what is rendered. Any thread but R.
    int sampleRateHz() const {
        const std::lock_guard lock{mutex_};
        return law_.sampleRateHz;
    }

    /// How long after its time what is told is felt where a session is direct, and by how much of session
    /// time such a one lets it stand ahead: L is their sum, the latter 0 if it is not direct. Any thread but
    /// R.
    double directSeconds() const {
        const std::lock_guard lock{mutex_};
        return static_cast<double>(law_.directFrames()) / law_.sampleRateHz;
    }
    std::int64_t toldAheadNs() const {
        const std::lock_guard lock{mutex_};
        return leadNs();
    }

    /// L. Any thread after prepare.
    std::int64_t playOutFrames() const noexcept { return playOutFrames_.load(std::memory_order_relaxed); }

    /// How long after its frame is felt what is born in the render call: L, or less where the session is
    /// direct. R, or M while nobody renders.
    bool isBornDirect() const noexcept { return isBornDirect_; } ///< as bornLatencyFrames
    std::int64_t bornLatencyFrames() const noexcept {
        return isBornDirect_ ? law_.limiterFrames : playOutFrames();
    }

    /// By how much L has grown since prepare, or is shorter. Any thread.
    std::int64_t framesGrown() const noexcept { return grownFrames_.load(std::memory_order_acquire); }

    /// Session time in frames, with the block that is being rendered. Any thread.
    std::int64_t framesRendered() const noexcept { return sessionFrames_.load(std::memory_order_relaxed); }

    /// The session time of a frame of the next block; before it, of one that is past, none of them before
    /// session time 0. R.
    std::int64_t nextNs(std::int64_t frame) const noexcept { return sessionNs(nextFrame(frame)); }

    /// The session time at which what is born in a frame of the next block stands. R.
    std::int64_t nextBornNs(std::int64_t frame) const noexcept {
        return isBornDirect_ ? nextRenderedNs(frame) : nextNs(frame);
    }

    /// The same in the renderer's frames, and that of what leaves it. R.
    std::int64_t nextBornFrame(std::int64_t frame) const noexcept {
        return isBornDirect_ ? nextRenderedFrame(frame) : nextFrame(frame);
    }
    std::int64_t nextRenderedFrame(std::int64_t frame) const noexcept {
        return nextFrame(frame - playOutFrames() + law_.limiterFrames);
    }

    /// The session time of what leaves the renderer, whose latency is part of L, as the next block's frame
    /// `frame`. R.
    std::int64_t nextRenderedNs(std::int64_t frame) const noexcept {
        return nextNs(frame - playOutFrames() + law_.limiterFrames);
    }

    /// The session time that is rendered first in the next block, to be felt when that leaves the device. R.
    std::int64_t nextFeltNs() const noexcept { return sessionNs(framesRendered() - playOutFrames()); }

private:
    friend class Session;
    friend class Scheduler;
    friend class WorldRunner;

    /// It is session time `frames` at the law's rate; L is the law's, nothing has been added to it. M, while
    /// nobody renders.
    void set(const ClockLaw& law, bool isToldDirect, bool isBornDirect, std::int64_t frames) {
        const std::lock_guard lock{mutex_};
        law_ = law;
        isToldDirect_ = isToldDirect;
        isBornDirect_ = isBornDirect;
        playOutFrames_ = law_.playOutFrames();
        grownFrames_ = 0;
        sessionFrames_ = frames;
    }
    const ClockLaw& law() const noexcept { return law_; }

    void setFrames(std::int64_t frames) noexcept { sessionFrames_ = frames; } ///< as set()

    /// L is that much longer from the start, or shorter. R or M, after prepare and before the first block; R,
    /// where as much of the renderer's time passes.
    void lengthen(std::int64_t frames) noexcept {
        playOutFrames_.fetch_add(frames, std::memory_order_relaxed);
        grownFrames_.fetch_add(frames, std::memory_order_release);
    }

    /// A block begins; session time before it. R, wait-free.
    std::int64_t tellFrames(int frames) noexcept {
        const std::int64_t done = sessionFrames_.load(std::memory_order_relaxed);
        sessionFrames_.store(done + frames, std::memory_order_release);
        return done;
    }

    /// A block passes that L grows by. L first: D, which reads both the other way round, must not take a gap
    /// for a stall. R, wait-free.
    void waitFrames(int frames) noexcept {
        lengthen(frames);
        sessionFrames_.fetch_add(frames, std::memory_order_release);
    }

    /// See Session::framesMissing; the world has been stepped to `steppedNs`, which is read after session
    /// time. A microsecond less than D lets pass: frames in whole nanoseconds do not add up to the last one.
    /// R, wait-free.
    std::int64_t framesMissing(int frames, const std::atomic<std::int64_t>& steppedNs) const noexcept {
        const std::int64_t lagNs =
            sessionNs(framesRendered() + frames) - steppedNs.load(std::memory_order_acquire);
        const std::int64_t missingNs = lagNs - longestLagNs() + 1000;
        const FrameClock clock{law_.sampleRateHz};
        return missingNs > 0 ? clock.at(missingNs).frame : -clock.at(-missingNs).frame + 1;
    }

    std::int64_t nextFrame(std::int64_t frame) const noexcept {
        return std::max<std::int64_t>(0, framesRendered() + frame);
    }

    /// At the law's rate. R, or whoever holds one of the mutexes.
    std::int64_t sessionNs(std::int64_t frames) const noexcept {
        return frames / law_.sampleRateHz * 1'000'000'000 +
               frames % law_.sampleRateHz * 1'000'000'000 / law_.sampleRateHz;
    }
    /// How much session time what is told lies ahead of what it is told at, to be felt sooner. Whoever holds
    /// one of the mutexes.
    std::int64_t leadNs() const noexcept {
        return isToldDirect_ ? sessionNs(playOutFrames() - law_.directFrames()) : 0;
    }
    std::int64_t nowNs() const noexcept { return sessionNs(sessionFrames_.load(std::memory_order_acquire)); }

    /// How far behind session time a driver that is in time sees the world at most, with what L has grown by.
    std::int64_t longestLagNs() const noexcept { return law_.longestLagNs() + sessionNs(framesGrown()); }

    mutable std::mutex mutex_; // taken last; guards the law against those who hold no other
    ClockLaw law_;
    bool isToldDirect_ = false, isBornDirect_ = false;
    // L, and what of it R has added to the law's
    std::atomic<std::int64_t> playOutFrames_{0}, grownFrames_{0};
    std::atomic<std::int64_t> sessionFrames_{0};
};

} // namespace physvib
