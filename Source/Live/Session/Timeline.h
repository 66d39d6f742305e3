// SPDX-License-Identifier: MIT
// Clock of a session: session time in frames and nanoseconds, and the output latency by which the output
// lags behind it.
#pragma once
#include "Core/ClockLaw.h"
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>

namespace physvib {

/// The session sets and resets it; the render thread (R) advances it. The law of the latency changes
/// only while no thread renders, under the mutexes of all parts.
class Timeline {
public:
    /// Session time. Any thread but R.
    std::int64_t presentNs() const {
        const std::lock_guard lock{mutex_};
        return nowNs();
    }

    /// Output latency. Any thread but R.
    double outputLatencySeconds() const {
        const std::lock_guard lock{mutex_};
        return static_cast<double>(outputLatencyFrames()) / law_.sampleRateHz;
    }

    /// Latency of sinks that the output latency covers. Any thread but R.
    double sinkSeconds() const {
        const std::lock_guard lock{mutex_};
        return law_.sinkSeconds;
    }

    /// Sample rate of the renderer. Any thread but R.
    int sampleRateHz() const {
        const std::lock_guard lock{mutex_};
        return law_.sampleRateHz;
    }

    /// Low-latency mode: latency of external inputs, and their lead time in session time. Their sum is the
    /// output latency; the lead time is 0 without that mode. Any thread but R.
    double directSeconds() const {
        const std::lock_guard lock{mutex_};
        return static_cast<double>(law_.directFrames()) / law_.sampleRateHz;
    }
    std::int64_t inputLeadNs() const {
        const std::lock_guard lock{mutex_};
        return leadNs();
    }

    /// Output latency. Any thread after prepare.
    std::int64_t outputLatencyFrames() const noexcept {
        return outputLatencyFrames_.load(std::memory_order_relaxed);
    }

    /// Latency of events of the render call: the output latency, or less in low-latency mode. R, or the
    /// message thread (M) while no thread renders.
    bool isDirectFromStart() const noexcept { return isDirectFromStart_; } ///< Direct::fromStart; R or M
    std::int64_t inputLatencyFrames() const noexcept {
        return isDirectFromStart_ ? law_.limiterFrames : outputLatencyFrames();
    }

    /// Change of the output latency since prepare. Any thread.
    std::int64_t latencyGrowthFrames() const noexcept {
        return latencyGrowthFrames_.load(std::memory_order_acquire);
    }

    /// Session time in frames, at the end of the block that is being rendered. Any thread.
    std::int64_t framesRendered() const noexcept { return sessionFrames_.load(std::memory_order_relaxed); }

    /// Session time of a frame of the next block; negative `frame`: of an earlier one. At least 0. R.
    std::int64_t nextNs(std::int64_t frame) const noexcept { return sessionNs(nextFrame(frame)); }

    /// Session time of an event that the render call creates at a frame of the next block. R.
    std::int64_t nextInputNs(std::int64_t frame) const noexcept { return sessionNs(nextInputFrame(frame)); }

    /// As nextInputNs(), in frames; and the session frame that leaves the renderer at `frame`. R.
    std::int64_t nextInputFrame(std::int64_t frame) const noexcept {
        return isDirectFromStart_ ? nextRenderedFrame(frame) : nextFrame(frame);
    }
    std::int64_t nextRenderedFrame(std::int64_t frame) const noexcept {
        return nextFrame(frame - outputLatencyFrames() + law_.limiterFrames);
    }

    /// Session time of what leaves the renderer at `frame` of the next block; the renderer's latency is part
    /// of the output latency. R.
    std::int64_t nextRenderedNs(std::int64_t frame) const noexcept {
        return sessionNs(nextRenderedFrame(frame));
    }

    /// Session time that is felt when the first frame of the next block leaves the device. R.
    std::int64_t nextOutputNs() const noexcept { return sessionNs(framesRendered() - outputLatencyFrames()); }

private:
    friend class Session;
    friend class Scheduler;
    friend class WorldRunner;

    /// Sets session time to `frames` at the law's rate, and the output latency to the law's. M, while no
    /// thread renders.
    void set(const ClockLaw& law, bool isDirect, bool isDirectFromStart, std::int64_t frames) {
        const std::lock_guard lock{mutex_};
        law_ = law;
        isDirect_ = isDirect;
        isDirectFromStart_ = isDirectFromStart;
        outputLatencyFrames_ = law_.outputLatencyFrames();
        latencyGrowthFrames_ = 0;
        sessionFrames_ = frames;
    }
    const ClockLaw& law() const noexcept { return law_; }

    /// Changes the output latency. R, if the renderer's time changes by as much.
    void lengthen(std::int64_t frames) noexcept {
        outputLatencyFrames_.fetch_add(frames, std::memory_order_relaxed);
        latencyGrowthFrames_.fetch_add(frames, std::memory_order_release);
    }

    /// Begins a block; returns the session time before it. R, wait-free.
    std::int64_t advanceFrames(int frames) noexcept {
        const std::int64_t done = sessionFrames_.load(std::memory_order_relaxed);
        sessionFrames_.store(done + frames, std::memory_order_release);
        return done;
    }

    /// A block by which the output latency grows. The latency is changed first: the driver (D), which reads
    /// both in the opposite order, must not take the difference for a stall. R, wait-free.
    void lengthenByBlock(int frames) noexcept {
        lengthen(frames);
        sessionFrames_.fetch_add(frames, std::memory_order_release);
    }

    /// See Session::framesMissing. The world has been stepped to `steppedNs`, which is read after session
    /// time. The limit is a microsecond below the driver's, because frames in whole nanoseconds accumulate
    /// rounding. R, wait-free.
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

    /// Session time of a number of frames. R, or a thread that holds one of the mutexes.
    std::int64_t sessionNs(std::int64_t frames) const noexcept {
        return FrameClock{law_.sampleRateHz}.timeNs(frames);
    }
    /// Lead time, in ns, applied to external inputs in low-latency mode. With one of the mutexes.
    std::int64_t leadNs() const noexcept {
        return isDirect_ ? sessionNs(outputLatencyFrames() - law_.directFrames()) : 0;
    }
    std::int64_t nowNs() const noexcept { return sessionNs(sessionFrames_.load(std::memory_order_acquire)); }

    /// Largest lag of the world behind session time that a driver in time can see, with the latency's growth.
    std::int64_t longestLagNs() const noexcept {
        return law_.longestLagNs() + sessionNs(latencyGrowthFrames());
    }

    mutable std::mutex mutex_; // locked last; guards the law for threads that hold no other mutex
    ClockLaw law_;
    bool isDirect_ = false, isDirectFromStart_ = false;
    // output latency, and its growth since prepare
    std::atomic<std::int64_t> outputLatencyFrames_{0}, latencyGrowthFrames_{0};
    std::atomic<std::int64_t> sessionFrames_{0};
};

} // namespace physvib
