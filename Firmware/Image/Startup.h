// SPDX-License-Identifier: MIT
// What the start-up code tells the program.
#pragma once
#include <cstdint>

namespace physvib::board {

/// How often the hardware watchdog has restarted us since power came. Call once.
std::uint8_t countWatchdogReset() noexcept;

/// Bytes of the stack that were never used.
std::uint16_t stackFree() noexcept;

} // namespace physvib::board
