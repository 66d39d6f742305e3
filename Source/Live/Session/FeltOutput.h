// SPDX-License-Identifier: MIT
// What all that follows a device has to know of it: when a moment is felt, how loud, and whether at all.
#pragma once
#include "Live/Session/SilenceHolders.h"
#include <algorithm>
#include <atomic>
#include <cstdint>

namespace physvib {

/// At `steadyNs` of the steady clock, hands feel what happened at `sessionNs`.
struct FeltMoment {
    std::int64_t sessionNs = 0, steadyNs = 0;
    std::int64_t behindNs = 0; ///< by which what is felt lies behind the present: L, and the device's own
    int sampleRateHz = 0;      ///< of the block
};

class FeltOutput {
public:
    /// `isEnded`, if there is one, outlives it: while it is true, nothing is felt. M.
    explicit FeltOutput(const std::atomic<bool>* isEnded = nullptr)
        : isEnded_{isEnded} {}

    /// Of the newest block that the session went on with; {}: none yet. Any thread but R.
    FeltMoment felt() const noexcept {
        for (;;) {
            const auto before = writes_.load(std::memory_order_acquire);
            const FeltMoment moment{
                sessionNs_.load(std::memory_order_acquire), steadyNs_.load(std::memory_order_acquire),
                behindNs_.load(std::memory_order_acquire), sampleRateHz_.load(std::memory_order_acquire)};
            if (before % 2 == 0 && writes_.load(std::memory_order_relaxed) == before) return moment;
        }
    }

    /// Master level, as a gain from 0 to 1. Any thread, wait-free, as what follows.
    float level() const noexcept { return level_.load(std::memory_order_relaxed); }
    void setLevel(float level) noexcept {
        level_.store(level > 0.0f ? std::min(level, 1.0f) : 0.0f, std::memory_order_relaxed);
    }

    /// Nothing is felt, whatever the level.
    bool isSilent() const noexcept {
        return silence_.isSilent() || (isEnded_ && isEnded_->load(std::memory_order_relaxed));
    }
    /// Who holds it silent.
    SilenceHolders& silence() noexcept { return silence_; }
    /// The wish of a person at the machine: silent within a block, or back in a ramp, whoever has asked for
    /// silence.
    void setSilent(bool silent) noexcept {
        silent ? void(silence_.ask(SilenceHolder::machine)) : silence_.liftAll();
    }

protected:
    ~FeltOutput() = default;

    /// R, wait-free.
    void tell(const FeltMoment& moment) noexcept {
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
    SilenceHolders silence_;
    std::atomic<float> level_{0.0f};
    // A moment, whole for any number of readers: while it is written, the count is odd, and each part shows
    // who reads it that it was.
    std::atomic<std::uint64_t> writes_{0};
    std::atomic<std::int64_t> sessionNs_{0}, steadyNs_{0}, behindNs_{0};
    std::atomic<int> sampleRateHz_{0};
};

} // namespace physvib
