// SPDX-License-Identifier: MIT
// Frames to I2S amplifiers: one state machine of the PIO per line, fed by DMA from two tiles in turn.
#pragma once
#include "Board.h"

namespace physvib::pico {

/// Starts clocks, silence, the interrupt that renders tiles, and the watchdog. Main loop, once.
void startOutput(Player<boardChannels>& player) noexcept;

/// Longest rendering of a tile so far, in cycles of the processor; 0 where it has no counter. Main loop.
std::uint32_t worstTileCycles() noexcept;

} // namespace physvib::pico
