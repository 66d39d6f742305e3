// SPDX-License-Identifier: MIT
// The only waits of the image that ask in a loop. Each ends: what the chip does within microseconds comes
// within a millisecond, or the chip is in a state that nobody knows.
#pragma once
#include "hardware/sync.h"
#include "hardware/timer.h"
#include "hardware/watchdog.h"

namespace physvib::pico {

/// Through the watchdog, which counts it: pins become inputs, and the amplifiers shut down. Any context.
[[noreturn]] inline void restart() noexcept {
    save_and_disable_interrupts(); // one of them feeds the watchdog
    watchdog_enable(1, false);
    for (;;) tight_loop_contents();
}

/// Until `isTrue()`; after a millisecond, restarts. Main loop.
template <class IsTrue>
void waitOrRestart(IsTrue&& isTrue) noexcept {
    constexpr std::uint32_t mostMicroseconds = 1000;
    for (const std::uint32_t began = time_us_32(); !isTrue();)
        if (time_us_32() - began > mostMicroseconds) restart();
}

} // namespace physvib::pico
