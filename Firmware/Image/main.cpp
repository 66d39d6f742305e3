// SPDX-License-Identifier: MIT
// Main program of the four-channel board: renders events from the serial line to codes for four converters.
// Three priorities: the sample timer's interrupt writes one frame to the converters, the serial interrupt
// moves bytes, and the main loop handles messages and renders a few frames ahead. The hardware watchdog is
// reset once per rendered block, so it detects when timer, interrupts or loop hang.
#include "BoardOutputs.h"
#include "Link.h"
#include "Registers.h"
#include <new>

namespace physvib::board {
namespace {

// constructed at run time, which saves 10 KB of the image
alignas(BoardRenderer) unsigned char rendererMemory[sizeof(BoardRenderer)];
FrameQueue outputs;
SerialPort serial;
Link link;

// The LED is on PA5.
void startLed() noexcept {
    reg(gpio::a + gpio::moder) = (reg(gpio::a + gpio::moder) & ~(3u << 10)) | 1u << 10;
}

// On: a host is connected. Blinking twice a second: silenced.
void updateLed() noexcept {
    const bool isOn = !link.isSilenced() || (outputs.played() & 2048) != 0;
    reg(gpio::a + gpio::bsrr) = isOn ? 1u << 5 : 1u << 21;
}

// Interrupt when the supply falls below 2.9 V (RM0364 6.2.2), before the processor resets at 2.0 V or less.
void startBrownOutDetector() noexcept {
    reg(rcc::apb1enr) |= 1u << 28;
    reg(pwr::cr) |= 7u << 5 | 1u << 4;
    reg(exti::rtsr1) |= 1u << 16;
    reg(exti::imr1) |= 1u << 16;
    enableInterrupt(irq::pvd, 0);
}

void startHardwareWatchdog() noexcept { // 50 ms at 40 kHz
    reg(iwdg::kr) = 0xCCCC;
    reg(iwdg::kr) = 0x5555;
    reg(iwdg::pr) = 0;
    reg(iwdg::rlr) = 500;
    reg(iwdg::kr) = 0xAAAA;
}

void startCycleCounter() noexcept {
    reg(core::demcr) |= 1u << 24;
    reg(core::dwtControl) |= 1;
}

// Never inlined into run(), so that the linker places it in the memory beside the core.
[[noreturn, gnu::noinline]] void loop(BoardRenderer& renderer) noexcept {
    for (;;) {
        while (!outputs.hasRoom()) asm volatile("wfi");
        link.poll(); // every half millisecond: at most six bytes have come
        BoardRenderer::Codes block;
        link.beforeBlock();
        const std::uint32_t startCycles = reg(core::dwtCycles);
        renderer.render(block);
        link.afterBlock(block, reg(core::dwtCycles) - startCycles);
        outputs.add(block);
        updateLed();
        reg(iwdg::kr) = 0xAAAA;
    }
}

[[noreturn]] void run() noexcept {
    reg(rcc::ahbenr) |= 1u << 17 | 1u << 19; // ports A and C
    DacBus::start();
    const Clock clock = startClock();
    auto& renderer = *new (rendererMemory) BoardRenderer;
    renderer.prepare();
    startLed();
    startCycleCounter();
    startBrownOutDetector();
    link.start({clock, countWatchdogReset(), &freeStackBytes}, renderer, outputs, serial);
    serial.start(clock, outputs);
    startHardwareWatchdog();
    startSampleTimer(clock);
    loop(renderer);
}

} // namespace
} // namespace physvib::board

extern "C" {

void sampleTimerInterrupt() {
    physvib::board::reg(physvib::board::tim6::sr) = 0;
    physvib::board::outputs.playNext();
}

void serialInterrupt() { physvib::board::serial.onInterrupt(); }

void work() { physvib::board::run(); }
}
