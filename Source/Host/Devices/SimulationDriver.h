// SPDX-License-Identifier: GPL-3.0-or-later
// Who steps a live session's world: the message thread's timer, or a thread of its own.
#pragma once
#include "Live/Session/Session.h"
#include <atomic>
#include <chrono>
#include <juce_events/juce_events.h>

namespace physvib {

/// Steps a session while it lives, and until `ends`, if there is one, is true: then after one step more at
/// most. One at a time per session. Made and destroyed on M.
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

/// A thread with absolute deadlines, one per step, so that lateness does not add up (driverThreadGapSeconds).
/// It runs at realtime priority where the system lets it: on a loaded machine an ordinary thread comes late
/// now and then.
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
