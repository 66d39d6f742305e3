// SPDX-License-Identifier: GPL-3.0-or-later
// JUCE's message loop for a while, in tests and their tools.
#pragma once
#include <functional>
#include <juce_events/juce_events.h>

namespace juce {
bool dispatchNextMessageOnSystemQueue(bool returnIfNoPendingMessages); // what a message loop is made of
}

namespace physvib::test {

/// Runs the message loop until `isTrue`, at most `seconds`; whether it became true.
inline bool runUntil(const std::function<bool()>& isTrue, double seconds = 20.0) {
    for (const double end = juce::Time::getMillisecondCounterHiRes() + 1e3 * seconds;
         juce::Time::getMillisecondCounterHiRes() < end;) {
        if (isTrue()) return true;
        if (!juce::dispatchNextMessageOnSystemQueue(true)) juce::Thread::sleep(1);
    }
    return isTrue();
}

inline void runFor(double seconds) {
    runUntil([] { return false; }, seconds);
}

} // namespace physvib::test
