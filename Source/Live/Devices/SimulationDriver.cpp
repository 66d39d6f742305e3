// SPDX-License-Identifier: MIT
// A thread with deadlines that steps a session's world.
#include "Live/Devices/SimulationDriver.h"
#include "Live/Session/ThisThread.h"
#include <algorithm>

namespace physvib {

ThreadDriver::ThreadDriver(Session& session, int stepsPerSecond, const std::atomic<bool>* ends)
    : session_{session}
    , step_{1'000'000'000 / std::min(stepsPerSecond, mostWakesPerSecond)}
    , ends_{ends}
    , thread_{[this] { run(); }} {}

ThreadDriver::~ThreadDriver() {
    isDestroyed_ = true;
    thread_.join();
}

void ThreadDriver::run() {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::nanoseconds leastPause{1'000'000}, mostPause{20'000'000}, mostHold{20'000'000};
    raiseThreadPriority();
    for (auto deadline = Clock::now(); !isOver(); deadline += step_) {
        // After a stall: no burst of ticks, and a pause for threads that wait for the world's mutex.
        if (const auto now = Clock::now(); now > deadline + 10 * step_)
            deadline = now + std::clamp<Clock::duration>((now - deadline) / 8, leastPause, mostPause);
        std::this_thread::sleep_until(deadline);
        const auto begin = Clock::now();
        bool wasLong = false; // a world too slow for real time: a thread that draws it waits a step or two,
                              // not until it has caught up
        session_.advance([&](auto) { return !(wasLong = Clock::now() - begin > mostHold) && !isOver(); });
        if (wasLong) std::this_thread::sleep_for(leastPause);
    }
}

} // namespace physvib
