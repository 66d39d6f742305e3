// SPDX-License-Identifier: MIT
// The four-channel board: serial messages in, codes for four converters out.
//
// Three levels: the sample timer's interrupt (writes one frame to the converters), the serial interrupt
// (moves bytes), and this loop (messages and rendering, a few frames ahead). Whatever hangs, the hardware
// watchdog notices: it is fed once per rendered block, so timer, interrupts and loop must all be alive.
#include "Clock.h"
#include "DacBus.h"
#include "Link.h"
#include "Outputs.h"
#include "SerialPort.h"
#include "Startup.h"
#include <new>

namespace physvib::board {
namespace {

// made at start: 10 KB of image less
alignas(BoardRenderer) unsigned char rendererMemory[sizeof(BoardRenderer)];
Outputs outputs;
SerialPort serial;
Link link;

// PA5
void startLed() noexcept {
    reg(gpio::a + gpio::moder) = (reg(gpio::a + gpio::moder) & ~(3u << 10)) | 1u << 10;
}

// Steady: somebody talks to us. Blinking twice a second: silent.
void showLed() noexcept {
    const bool isOn = !link.isSilenced() || (outputs.played() & 2048) != 0;
    reg(gpio::a + gpio::bsrr) = isOn ? 1u << 5 : 1u << 21;
}

// The supply falls below 2.9 V (RM0364 6.2.2): an interrupt, before the processor's own reset at 2.0 V or
// less.
void startBrownOutDetector() noexcept {
    reg(rcc::apb1enr) |= 1u << 28;
    reg(pwr::cr) |= 7u << 5 | 1u << 4;
    reg(exti::rtsr1) |= 1u << 16;
    reg(exti::imr1) |= 1u << 16;
    enableInterrupt(irq::pvd, 0);
}

void startHardwareWatchdog() noexcept { // 50 ms of the 40 kHz oscillator
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

// Apart from the start and never inlined there: the linker puts it beside the core.
[[noreturn, gnu::noinline]] void loop(BoardRenderer& renderer) noexcept {
    for (;;) {
        while (!outputs.hasRoom()) asm volatile("wfi");
        link.poll(); // every half millisecond: six bytes of the line at most
        BoardRenderer::Codes block;
        link.beforeBlock();
        const std::uint32_t began = reg(core::dwtCycles);
        renderer.render(block);
        link.afterBlock(block, reg(core::dwtCycles) - began);
        outputs.put(block);
        showLed();
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
    link.start({clock, countWatchdogReset(), &stackFree}, renderer, outputs, serial);
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

void serialInterrupt() { physvib::board::serial.serve(); }

int main() { physvib::board::run(); }
}
