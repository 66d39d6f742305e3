// SPDX-License-Identifier: MIT
// Starts the processor clock (72 MHz from the ST-Link's 8 MHz, or 64 MHz from the internal oscillator if that
// is missing) and the sample timer.
#pragma once
#include "Core/Limits.h"
#include "Registers.h"
#include <cstdint>

namespace physvib::board {

/// The processor clock.
struct Clock {
    std::uint32_t hz = 0;
    bool isCrystal = false;
    std::uint32_t cyclesPerFrame() const noexcept { return hz / limits::board::sampleRateHz; }
};

/// Starts the clock (RM0364 8.2). The slow peripheral bus runs at half its frequency, the timer at the full
/// one.
inline Clock startClock() noexcept {
    constexpr std::uint32_t hseOn = 1u << 16, hseReady = 1u << 17, hseBypass = 1u << 18, pllOn = 1u << 24,
                            pllReady = 1u << 25;
    constexpr std::uint32_t halfForApb1 = 4u << 8, fromHse = 1u << 16, times9 = 7u << 18, times16 = 14u << 18;
    constexpr std::uint32_t toPll = 2, onPll = 2u << 2;
    constexpr int patience = 20000; // 10 ms at 8 MHz; the ST-Link's clock is ready within 2 ms
    reg(flash::acr) = 2u | 1u << 4; // two wait states, required above 48 MHz; prefetch
    reg(rcc::cr) |= hseBypass | hseOn;
    bool hasCrystal = false;
    for (int i = 0; i < patience && !hasCrystal; ++i) hasCrystal = (reg(rcc::cr) & hseReady) != 0;
    reg(rcc::cfgr) = halfForApb1 | (hasCrystal ? fromHse | times9 : times16); // 8 MHz x 9, or 8 MHz / 2 x 16
    reg(rcc::cr) |= pllOn;
    while ((reg(rcc::cr) & pllReady) == 0) {
    }
    reg(rcc::cfgr) |= toPll;
    while ((reg(rcc::cfgr) & (3u << 2)) != onPll) {
    }
    return {hasCrystal ? 72'000'000u : 64'000'000u, hasCrystal};
}

/// Interrupts at the sample rate, with the highest priority.
inline void startSampleTimer(const Clock& clock) noexcept {
    reg(tim6::psc) = 0;
    reg(tim6::arr) = clock.cyclesPerFrame() - 1;
    reg(tim6::dier) = 1;
    enableInterrupt(irq::tim6, 0);
    reg(tim6::cr1) = 1;
}

} // namespace physvib::board
