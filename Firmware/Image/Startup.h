// SPDX-License-Identifier: MIT
// Facts from the start-up code: watchdog resets and unused stack.
#pragma once
#include <cstdint>

namespace physvib::board {

/// Number of restarts by the hardware watchdog since power-on. Call once.
std::uint8_t countWatchdogReset() noexcept;

/// Bytes of the stack that have never been used.
std::uint16_t stackFree() noexcept;

} // namespace physvib::board
