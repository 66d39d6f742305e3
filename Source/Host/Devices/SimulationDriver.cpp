// SPDX-License-Identifier: GPL-3.0-or-later
// Steps a session's world from JUCE's timer or from a thread with deadlines.
#include "Host/Devices/SimulationDriver.h"
#include <algorithm>
#include <thread>

namespace physvib {

namespace {

bool isOver(const std::atomic<bool>* ends) { return ends != nullptr && *ends; }

} // namespace

MessageTimerDriver::MessageTimerDriver(Session& session, const std::atomic<bool>* ends)
    : session_{session}
    , ends_{ends} {
    startTimer(10);
}

void MessageTimerDriver::timerCallback() {
    if (!isOver(ends_)) session_.advance([this](auto) { return !isOver(ends_); });
}

ThreadDriver::ThreadDriver(Session& session, int stepsPerSecond, const std::atomic<bool>* ends)
    : juce::Thread{"PhysVib driver"}
    , session_{session}
    , step_{1'000'000'000 / stepsPerSecond}
    , ends_{ends} {
    if (!startRealtimeThread({})) startThread(Priority::highest); // realtime needs a privilege
}

ThreadDriver::~ThreadDriver() { stopThread(-1); }

void ThreadDriver::run() {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::nanoseconds leastPause{1'000'000}, mostPause{20'000'000}, mostHold{20'000'000};
    for (auto deadline = Clock::now(); !threadShouldExit() && !isOver(ends_); deadline += step_) {
        // After a stall: no burst of ticks, and a pause for threads that wait for the world's mutex.
        if (const auto now = Clock::now(); now > deadline + 10 * step_)
            deadline = now + std::clamp<Clock::duration>((now - deadline) / 8, leastPause, mostPause);
        std::this_thread::sleep_until(deadline);
        const auto begin = Clock::now();
        bool wasLong = false; // a world too slow for real time: a thread that draws it waits a step or two,
                              // not until it has caught up
        session_.advance([&](auto) {
            return !(wasLong = Clock::now() - begin > mostHold) && !threadShouldExit() && !isOver(ends_);
        });
        if (wasLong) std::this_thread::sleep_for(leastPause);
    }
}

} // namespace physvib
