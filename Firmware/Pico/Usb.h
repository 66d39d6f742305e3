// SPDX-License-Identifier: MIT
// The board as a USB device: packets to the player, volume, and a serial port that answers in text.
#pragma once
#include "Board.h"

namespace physvib::pico {

/// Starts USB and restores settings after a watchdog restart. Main loop, once.
void startUsb(Player<boardChannels>& player, std::uint32_t watchdogRestarts) noexcept;

/// Serves the host. Main loop, at least once a millisecond.
void pollUsb() noexcept;

/// Number of packets that were dropped, missing or of a wrong size, and of restarts. Main loop.
std::uint32_t errorCount() noexcept;

} // namespace physvib::pico
