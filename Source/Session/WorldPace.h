// SPDX-License-Identifier: MIT
// How fast a session's world goes: slower, not at all, step by step.
#pragma once
#include <algorithm>
#include <atomic>

namespace physvib {

/// Part of a session. What has been struck rings on; a slower world is logged as stalls.
class WorldPace {
public:
    /// How fast the world goes from its next step on: each step takes `slowness` times its time; 0: it stands still. Any
    /// thread, wait-free.
    void setSlowness(int slowness) noexcept { slowness_.store(std::max(0, slowness), std::memory_order_relaxed); }
    int slowness() const noexcept { return slowness_.load(std::memory_order_relaxed); }

    /// One step of a world that stands still. Any thread, wait-free.
    void stepOnce() noexcept { stepsWanted_.fetch_add(1, std::memory_order_relaxed); }

protected:
    ~WorldPace() = default;

    /// As at first. M.
    void resetPace() noexcept {
        slowness_ = 1;
        stepsWanted_ = 0;
    }

    /// Whether one step was asked for; it has been made then. Whoever holds the world.
    bool takeStep() noexcept {
        if (stepsWanted_.load(std::memory_order_relaxed) == 0) return false;
        stepsWanted_.fetch_sub(1, std::memory_order_relaxed);
        return true;
    }

private:
    std::atomic<int> slowness_{1}, stepsWanted_{0};
};

} // namespace physvib
