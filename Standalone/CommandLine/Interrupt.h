// SPDX-License-Identifier: GPL-3.0-or-later
// The user's wish to stop, from Ctrl-C or `kill`: what plays ends in order.
#pragma once
#include <atomic>
#include <csignal>

namespace physvib {

inline std::atomic<bool> interrupted{false}; // what plays on a device reads it in every block: silence comes before all else ends
static_assert(std::atomic<bool>::is_always_lock_free, "a signal may set it");

/// From now on these signals set `interrupted` and end nothing by themselves.
inline void heedInterrupts() {
    const auto interrupt = [](int) { interrupted = true; };
    std::signal(SIGINT, interrupt);
    std::signal(SIGTERM, interrupt);
}

} // namespace physvib
