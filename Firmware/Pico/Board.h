// SPDX-License-Identifier: MIT
// Pins and clock of the Pico, restarts, and the output to I2S amplifiers: per line one state machine of the
// PIO, which DMA feeds from two tiles in turn. All wires are on one side of the board, beside each other.
#pragma once
#include "Signal/Player.h"
#include "hardware/sync.h"
#include "hardware/timer.h"
#include "hardware/watchdog.h"

namespace physvib::pico {

constexpr int boardChannels = PHYSVIB_PICO_CHANNELS;
constexpr int boardLines = boardChannels / 2; // an I2S line carries two channels: left, then right

constexpr unsigned firstDataPin = 2; // GP2 (and 3; with eight channels 4 and 5): data of the lines
constexpr unsigned bitClockPin = 6;  // GP6: bit clock, GP7: word clock, of all lines
constexpr unsigned amplifierPin = 8; // GP8: high while the amplifiers shall be on
constexpr unsigned ceilingPin = 9;   // GP9: open, the ceiling is a quarter; tied to ground, full scale
constexpr unsigned ledPin = 25;

// 25 cycles per step of the I2S program, without a remainder, so that bit clocks do not jitter; 76.8 MHz
// serve eight channels with a third of the processor.
constexpr unsigned systemClockHz = 76'800'000;
constexpr unsigned stepsPerFrame = 64; // two per bit
constexpr unsigned clockDivider = systemClockHz / (stepsPerFrame * sampleRateHz);
static_assert(clockDivider * stepsPerFrame * sampleRateHz == systemClockHz);

// The only busy waits of the image, each at most a millisecond: a chip in a known state needs microseconds.

/// Restarts by the watchdog, which counts it: pins become inputs, and the amplifiers shut down. Any context.
[[noreturn]] inline void restart() noexcept {
    save_and_disable_interrupts(); // an interrupt feeds the watchdog
    watchdog_enable(1, false);
    for (;;) tight_loop_contents();
}

/// Waits until `isTrue()`; restarts after a millisecond. Main loop.
template <class IsTrue>
void waitOrRestart(IsTrue&& isTrue) noexcept {
    constexpr std::uint32_t maxMicroseconds = 1000;
    for (const std::uint32_t startUs = time_us_32(); !isTrue();)
        if (time_us_32() - startUs > maxMicroseconds) restart();
}

/// Starts clocks, silence, the interrupt that renders tiles, and the watchdog. Main loop, once.
void startOutput(Player<boardChannels>& player) noexcept;

/// Longest rendering of a tile so far, in cycles of the processor; 0 where it has no counter. Main loop.
std::uint32_t worstTileCycles() noexcept;

} // namespace physvib::pico
