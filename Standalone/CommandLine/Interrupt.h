// SPDX-License-Identifier: GPL-3.0-or-later
// The user's wish to stop, from Ctrl-C or `kill`: what plays ends in order.
#pragma once
#include <csignal>

namespace physvib {

inline volatile std::sig_atomic_t interrupted = 0;

/// From now on these signals set `interrupted` and end nothing by themselves.
inline void heedInterrupts() {
    const auto interrupt = [](int) { interrupted = 1; };
    std::signal(SIGINT, interrupt);
    std::signal(SIGTERM, interrupt);
}

} // namespace physvib
