// SPDX-License-Identifier: MIT
// State of an output device for the sinks that follow it: when a session time is felt, the master level, and
// mute.
#pragma once
#include "Live/Session/MuteRequests.h"
#include <algorithm>
#include <atomic>
#include <cstdint>

namespace physvib {

/// What happened at `sessionNs` is felt at `steadyNs` of the steady clock.
struct OutputMoment {
    std::int64_t sessionNs = 0, steadyNs = 0;
    std::int64_t behindNs = 0; ///< lag of the felt time behind the present: output latency plus the
                               ///< device's own
    int sampleRateHz = 0;      ///< of the block
};

class OutputClock {
public:
    /// `isEnded`, if given, outlives it: while it is true, the output is silent. Message thread (M).
    explicit OutputClock(const std::atomic<bool>* isEnded = nullptr)
        : isEnded_{isEnded} {}

    /// Of the newest block; {}: none yet. Any thread but the render thread (R).
    OutputMoment felt() const noexcept {
        for (;;) {
            const auto before = writes_.load(std::memory_order_acquire);
            const OutputMoment moment{
                sessionNs_.load(std::memory_order_acquire), steadyNs_.load(std::memory_order_acquire),
                behindNs_.load(std::memory_order_acquire), sampleRateHz_.load(std::memory_order_acquire)};
            if (before % 2 == 0 && writes_.load(std::memory_order_relaxed) == before) return moment;
        }
    }

    /// Master level, a gain from 0 to 1. Any thread, wait-free, as the next ones.
    float level() const noexcept { return level_.load(std::memory_order_relaxed); }
    void setLevel(float level) noexcept {
        level_.store(level > 0.0f ? std::min(level, 1.0f) : 0.0f, std::memory_order_relaxed);
    }

    /// True if the output is muted, whatever the level.
    bool isSilent() const noexcept {
        return silence_.isSilent() || (isEnded_ && isEnded_->load(std::memory_order_relaxed));
    }
    /// The requests for silence by input.
    MuteRequests& silence() noexcept { return silence_; }
    /// The user's choice at this computer: silent within a block, or, regardless of all requests for silence,
    /// sounding again in a ramp.
    void setSilent(bool silent) noexcept {
        silent ? void(silence_.request(MuteRequester::machine)) : silence_.liftAll();
    }

protected:
    ~OutputClock() = default;

    /// R, wait-free.
    void tell(const OutputMoment& moment) noexcept {
        const auto before = writes_.load(std::memory_order_relaxed);
        writes_.store(before + 1, std::memory_order_relaxed);
        sessionNs_.store(moment.sessionNs, std::memory_order_release);
        steadyNs_.store(moment.steadyNs, std::memory_order_release);
        behindNs_.store(moment.behindNs, std::memory_order_release);
        sampleRateHz_.store(moment.sampleRateHz, std::memory_order_release);
        writes_.store(before + 2, std::memory_order_release);
    }

private:
    const std::atomic<bool>* const isEnded_;
    MuteRequests silence_;
    std::atomic<float> level_{0.0f};
    // A seqlock for any number of readers: the count is odd during a write, and a reader repeats if it has
    // changed.
    std::atomic<std::uint64_t> writes_{0};
    std::atomic<std::int64_t> sessionNs_{0}, steadyNs_{0}, behindNs_{0};
    std::atomic<int> sampleRateHz_{0};
};

} // namespace physvib
