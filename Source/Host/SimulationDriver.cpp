// SPDX-License-Identifier: GPL-3.0-or-later
// Timer and thread.
#include "Host/SimulationDriver.h"
#include <chrono>

namespace physvib {

MessageTimerDriver::MessageTimerDriver(Session& session)
    : session_{session} {
    startTimer(10);
}

ThreadDriver::ThreadDriver(Session& session, int stepsPerSecond)
    : session_{session}
    , thread_{[this, stepsPerSecond] { run(stepsPerSecond); }} {}

ThreadDriver::~ThreadDriver() {
    stop_ = true;
    thread_.join();
}

void ThreadDriver::run(int stepsPerSecond) {
    using Clock = std::chrono::steady_clock;
    const std::chrono::nanoseconds step{1'000'000'000 / stepsPerSecond};
    for (auto deadline = Clock::now(); !stop_; deadline += step) {
        if (const auto now = Clock::now(); now > deadline + 10 * step) deadline = now; // after a stall: no burst of ticks
        std::this_thread::sleep_until(deadline);
        session_.advance();
    }
}

} // namespace physvib
