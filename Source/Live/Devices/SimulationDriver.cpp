// SPDX-License-Identifier: MIT
// A thread that steps a session's world.
#include "Live/Devices/SimulationDriver.h"
#include "Live/Session/ThisThread.h"
#include <algorithm>

namespace physvib {

ThreadDriver::ThreadDriver(Session& session, int stepsPerSecond, const std::atomic<bool>* ends)
    : session_{session}
    , stepNs_{std::max(poll, std::int64_t{1'000'000'000} / stepsPerSecond)}
    , ends_{ends}
    , thread_{[this] { run(); }} {}

ThreadDriver::~ThreadDriver() {
    isDestroyed_ = true;
    thread_.join();
}

void ThreadDriver::run() {
    raiseThreadPriority(false);
    while (!isOver()) {
        const std::int64_t begin = steadyNs();
        // a thread that draws a world too slow for real time waits a step or two, not until it has caught up
        session_.advance([&](auto) { return steadyNs() - begin <= mostHold && !isOver(); });
        const std::int64_t now = steadyNs(), left = session_.world().nextStepNs() - now;
        std::int64_t pause = std::max(left, std::int64_t{0}) + poll; // by then the block is rendered
        if (left > longestBlock) pause = 4 * poll;                   // the first block may come at any time
        if (session_.pulse().isStill(now)) pause = stepNs_;
        std::this_thread::sleep_for(std::chrono::nanoseconds{std::max(pause, (now - begin) / 8)});
    }
}

} // namespace physvib
