// SPDX-License-Identifier: GPL-3.0-or-later
// Steps the world of a live session, by the message thread's timer or by a thread of its own.
#pragma once
#include "Live/Session/Session.h"
#include <atomic>
#include <chrono>
#include <juce_events/juce_events.h>

namespace physvib {

/// Steps a session from construction to destruction, or until `ends` (may be null) is true; then at most one
/// more step follows. One driver at a time per session. Created and destroyed on M.
class SimulationDriver {
public:
    virtual ~SimulationDriver() = default;
};

/// JUCE's timer on the message thread, every 10 ms (messageTimerGapSeconds). The default.
class MessageTimerDriver final : public SimulationDriver, private juce::Timer {
public:
    explicit MessageTimerDriver(Session& session, const std::atomic<bool>* ends = nullptr);
    ~MessageTimerDriver() override { stopTimer(); }

private:
    void timerCallback() override;
    Session& session_;
    const std::atomic<bool>* const ends_;
};

/// A thread with absolute deadlines, one per step, so that delays do not add up (driverThreadGapSeconds). It
/// runs at realtime priority where the system permits, because an ordinary thread is sometimes late on a
/// loaded machine.
class ThreadDriver final : public SimulationDriver, private juce::Thread {
public:
    /// `stepsPerSecond` up to 1000.
    ThreadDriver(Session& session, int stepsPerSecond, const std::atomic<bool>* ends = nullptr);
    ~ThreadDriver() override;

private:
    void run() override;
    Session& session_;
    const std::chrono::nanoseconds step_;
    const std::atomic<bool>* const ends_;
};

} // namespace physvib
