// SPDX-License-Identifier: MIT
// A loop at a steady pace, for programs without a message loop.
#pragma once
#include <chrono>
#include <thread>

namespace physvib {

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
