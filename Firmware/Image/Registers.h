// SPDX-License-Identifier: MIT
// Registers, named as in ST's manual RM0364 and the ARMv7-M manual, and the start of clock and timer.
#pragma once
#include "Core/Limits.h"
#include <cstdint>

namespace physvib::board {
/// One 32-bit register.
inline volatile std::uint32_t& reg(std::uint32_t address) noexcept {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}

namespace rcc { // RM0364 chapter 8
constexpr std::uint32_t cr = 0x40021000, cfgr = 0x40021004, ahbenr = 0x40021014, apb2enr = 0x40021018,
                        apb1enr = 0x4002101C, csr = 0x40021024, cfgr3 = 0x40021030;
}
namespace flash { // chapter 3
constexpr std::uint32_t acr = 0x40022000;
}
namespace gpio { // chapter 9
constexpr std::uint32_t a = 0x48000000, c = 0x48000800;
constexpr std::uint32_t moder = 0x00, ospeedr = 0x08, odr = 0x14, bsrr = 0x18, afrl = 0x20, afrh = 0x24;
} // namespace gpio
namespace exti { // chapter 12
constexpr std::uint32_t imr1 = 0x40010400, rtsr1 = 0x40010408, pr1 = 0x40010414;
}
namespace tim6 { // chapter 20
constexpr std::uint32_t cr1 = 0x40001000, dier = 0x4000100C, sr = 0x40001010, cnt = 0x40001024,
                        psc = 0x40001028, arr = 0x4000102C;
}
namespace iwdg { // chapter 24
constexpr std::uint32_t kr = 0x40003000, pr = 0x40003004, rlr = 0x40003008;
}
namespace pwr { // chapter 6
constexpr std::uint32_t cr = 0x40007000;
}
namespace usart { // chapter 28
constexpr std::uint32_t usart1 = 0x40013800, usart2 = 0x40004400;
constexpr std::uint32_t cr1 = 0x00, brr = 0x0C, isr = 0x1C, icr = 0x20, rdr = 0x24, tdr = 0x28;
} // namespace usart
namespace core { // ARMv7-M manual, B3 and C1
constexpr std::uint32_t nvicEnable = 0xE000E100, nvicPriority = 0xE000E400, cpacr = 0xE000ED88,
                        demcr = 0xE000EDFC, dwtControl = 0xE0001000, dwtCycles = 0xE0001004;
}
namespace irq { // RM0364 table 30
constexpr int pvd = 1, usart1 = 37, usart2 = 38, tim6 = 54;
}

/// Priority 0 interrupts all others.
inline void enableInterrupt(int number, std::uint8_t priority) noexcept {
    *reinterpret_cast<volatile std::uint8_t*>(core::nvicPriority + static_cast<std::uint32_t>(number)) =
        static_cast<std::uint8_t>(priority << 4);
    reg(core::nvicEnable + 4u * static_cast<std::uint32_t>(number / 32)) = 1u << (number % 32);
}

/// The processor clock: 72 MHz from the ST-Link's 8 MHz, or 64 MHz from the internal oscillator if that is
/// missing.
struct Clock {
    std::uint32_t hz = 0;
    bool isCrystal = false;
    std::uint32_t cyclesPerFrame() const noexcept { return hz / limits::board::sampleRateHz; }
};

/// Starts the clock (RM0364 8.2). The slow peripheral bus runs at half its frequency, the timer at all of it.
inline Clock startClock() noexcept {
    constexpr std::uint32_t hseOn = 1u << 16, hseReady = 1u << 17, hseBypass = 1u << 18, pllOn = 1u << 24,
                            pllReady = 1u << 25;
    constexpr std::uint32_t halfForApb1 = 4u << 8, fromHse = 1u << 16, times9 = 7u << 18, times16 = 14u << 18;
    constexpr std::uint32_t toPll = 2, onPll = 2u << 2;
    constexpr int maxPolls = 20000; // 10 ms at 8 MHz; the ST-Link's clock is ready within 2 ms
    reg(flash::acr) = 2u | 1u << 4; // two wait states, required above 48 MHz; prefetch
    reg(rcc::cr) |= hseBypass | hseOn;
    bool hasCrystal = false;
    for (int i = 0; i < maxPolls && !hasCrystal; ++i) hasCrystal = (reg(rcc::cr) & hseReady) != 0;
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

/// Number of restarts by the hardware watchdog since power-on. Call once.
std::uint8_t countWatchdogReset() noexcept;

/// Bytes of the stack that have never been used.
std::uint16_t freeStackBytes() noexcept;

} // namespace physvib::board
