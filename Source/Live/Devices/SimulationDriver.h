// SPDX-License-Identifier: MIT
// Steps the world of a live session on a thread of its own.
#pragma once
#include "Live/Session/Session.h"
#include <atomic>
#include <chrono>
#include <thread>

namespace physvib {
/// A thread that wakes when the next step is due, by the blocks of the device (threadGapSeconds). It runs at
/// realtime priority where the system permits, because an ordinary thread is sometimes late on a loaded
/// machine. It steps the session from construction to destruction, or until `ends` (may be null) is true;
/// then at most one more step follows. One driver at a time per session. Created and destroyed on M.
class ThreadDriver {
public:
    ThreadDriver(Session& session, int stepsPerSecond, const std::atomic<bool>* ends = nullptr);
    ~ThreadDriver();
    ThreadDriver(const ThreadDriver&) = delete;
    ThreadDriver& operator=(const ThreadDriver&) = delete;

private:
    static constexpr std::int64_t poll = 250'000, mostHold = 20'000'000, longestBlock = 500'000'000; // ns
    void run();
    bool isOver() const noexcept { return isDestroyed_ || (ends_ != nullptr && *ends_); }

    Session& session_;
    const std::int64_t stepNs_;
    const std::atomic<bool>* const ends_;
    std::atomic<bool> isDestroyed_{false};
    std::thread thread_;
};

// A loop at a steady pace, for programs without a message loop.

/// Calls `tick()` once per period until it returns false. Ticks that a stall has missed are left out.
template <class Tick>
void repeatEvery(std::chrono::milliseconds period, Tick tick) {
    using Clock = std::chrono::steady_clock;
    for (auto next = Clock::now() + period;; next += period) {
        std::this_thread::sleep_until(next);
        if (!tick()) return;
        if (const auto now = Clock::now(); now > next + period) next = now;
    }
}

} // namespace physvib
