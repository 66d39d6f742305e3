// SPDX-License-Identifier: MIT
// Whether the device that plays a session asks for blocks. While it does not, session time stands still, and
// what came meanwhile would be felt all at once when it comes back: it is dropped, and counted.
#pragma once
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>

namespace physvib {

/// A time of the steady clock, in nanoseconds.
inline std::int64_t
steadyNs(std::chrono::steady_clock::time_point at = std::chrono::steady_clock::now()) noexcept {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(at.time_since_epoch()).count();
}

/// Times are steadyNs().
class DevicePulse {
public:
    static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
    static constexpr std::int64_t goneNs = 2'000'000'000; ///< a device that pauses longer counts as gone

    /// The longest pause of a device that runs, in blocks of `blockNs`: three of them, and at least 100 ms.
    static constexpr std::int64_t limitNs(std::int64_t blockNs) noexcept {
        return 3 * blockNs > 100'000'000 ? 3 * blockNs : 100'000'000;
    }

    /// A device starts that pauses for at most `limitNs`; never: its pauses do not count. The first one has
    /// goneNs until its first block. Message thread (M), while the render thread (R)
    /// does not run.
    void begin(std::int64_t limitNs, std::int64_t nowNs) noexcept {
        limitNs_.store(limitNs, std::memory_order_relaxed);
        if (lastNs_.load(std::memory_order_relaxed) == never)
            lastNs_.store(nowNs + goneNs, std::memory_order_release);
    }

    /// What waits for a device and is dropped when it is back: strikes up to a session time; all after a
    /// pause so long that the device counts as gone.
    struct Return {
        std::uint64_t pauses = 0, losses = 0; ///< ended so far; losses: the long ones
        std::int64_t untilNs = 0;             ///< of the last pause
    };
    /// The first block after a pause begins, at session time `sessionNs`. Returns whether the device was
    /// gone. R, wait-free.
    bool comeBack(std::int64_t nowNs, std::int64_t sessionNs) noexcept {
        const bool wasGone = nowNs - lastNs_.load(std::memory_order_relaxed) > goneNs;
        untilNs_.store(sessionNs, std::memory_order_relaxed);
        losses_.fetch_add(wasGone ? 1 : 0, std::memory_order_relaxed);
        pauses_.fetch_add(1, std::memory_order_release);
        return wasGone;
    }
    /// A block that began at `nowNs` has been rendered: from now on the device runs. R, wait-free.
    void beat(std::int64_t nowNs) noexcept { lastNs_.store(nowNs, std::memory_order_release); }
    /// When the last block began, by beat(); before the first one far away. Any thread.
    std::int64_t lastNs() const noexcept {
        return std::min(lastNs_.load(std::memory_order_acquire), never / 2);
    }
    /// The device is closed, and no other opened: an endless pause. M, while R does not run.
    void end() noexcept { limitNs_.store(0, std::memory_order_relaxed); }

    /// Whether the device pauses. False before the first begin(): the session has no device. Any thread.
    bool isStill(std::int64_t nowNs) const noexcept {
        const std::int64_t last = lastNs_.load(std::memory_order_acquire),
                           limit = limitNs_.load(std::memory_order_relaxed);
        return last != never && limit != never && nowNs - last > limit;
    }

    /// Any thread, wait-free.
    Return returns() const noexcept {
        const std::uint64_t pauses = pauses_.load(std::memory_order_acquire);
        return {pauses, losses_.load(std::memory_order_relaxed), untilNs_.load(std::memory_order_relaxed)};
    }

    /// Counts events that are not played. Any thread, wait-free, as the next ones.
    void drop(std::uint64_t events) noexcept { dropped_.fetch_add(events, std::memory_order_relaxed); }
    /// True, and these events are counted as dropped, while the device pauses.
    bool dropsNow(std::uint64_t events) noexcept {
        if (!isStill(steadyNs())) return false;
        drop(events);
        return true;
    }
    std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

    /// The error of an input that is dropped.
    static constexpr const char* refusal = "no device runs: dropped";

private:
    std::atomic<std::int64_t> lastNs_{never}, limitNs_{never};
    std::atomic<std::int64_t> untilNs_{0};
    std::atomic<std::uint64_t> pauses_{0}, losses_{0}, dropped_{0};
};

} // namespace physvib
