// SPDX-License-Identifier: GPL-3.0-or-later
// Timer and thread.
#include "Host/Devices/SimulationDriver.h"
#include <thread>

namespace physvib {

MessageTimerDriver::MessageTimerDriver(Session& session)
    : session_{session} {
    startTimer(10);
}

ThreadDriver::ThreadDriver(Session& session, int stepsPerSecond)
    : juce::Thread{"PhysVib driver"}
    , session_{session}
    , step_{1'000'000'000 / stepsPerSecond} {
    if (!startRealtimeThread({})) startThread(Priority::highest); // few users are allowed the first
}

ThreadDriver::~ThreadDriver() { stopThread(-1); }

void ThreadDriver::run() {
    using Clock = std::chrono::steady_clock;
    for (auto deadline = Clock::now(); !threadShouldExit(); deadline += step_) {
        if (const auto now = Clock::now(); now > deadline + 10 * step_) deadline = now; // after a stall: no burst of ticks
        std::this_thread::sleep_until(deadline);
        session_.advance([this](auto) { return !threadShouldExit(); });
    }
}

} // namespace physvib
