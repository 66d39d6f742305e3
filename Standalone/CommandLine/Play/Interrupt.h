// SPDX-License-Identifier: GPL-3.0-or-later
// The user's wish to stop, from Ctrl-C, `kill` or a terminal that is closed: what plays ends in order.
#pragma once
#include "CommandLine/Process.h"
#include <atomic>

namespace physvib {

inline std::atomic<bool> interrupted{false}; // what plays on a device reads it in every block: silence comes before all else ends
static_assert(std::atomic<bool>::is_always_lock_free, "a signal may set it");

/// From now on these signals set `interrupted` and end nothing by themselves; the second ends a program that hangs. A reader of
/// standard output that goes away ends nothing either: what was recorded is still to be put in its place.
inline void heedInterrupts() {
    const auto interrupt = [](int signal) {
        if (interrupted.exchange(true)) endBySignal(signal);
    };
    catchEnding(interrupt, KeepIgnored::hangUp); // a script's background ignores SIGINT, and yet means it
    ignoreLostReader();
}

} // namespace physvib
