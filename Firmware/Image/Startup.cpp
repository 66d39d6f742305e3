// SPDX-License-Identifier: MIT
// Start-up from reset to main: memory, floating-point unit, stack paint, interrupt vectors. Every processor
// fault silences the outputs, and the hardware watchdog then restarts the board.
#include "Outputs.h"
#include "Registers.h"
#include <array>
#include <cstring>

extern "C" {
extern std::uint32_t linkStackTop, linkStackBottom, linkDataLoad, linkData, linkDataEnd, linkBss, linkBssEnd;
extern std::uint32_t linkFastLoad, linkFast, linkFastEnd;
void work();
void sampleTimerInterrupt();
void serialInterrupt();
[[noreturn]] void startUp();
[[noreturn]] void fault();
}

namespace physvib::board {
namespace {

constexpr std::uint32_t paint = 0xA5C35A3C;
__attribute__((section(".noinit"))) std::uint32_t resets; // survives a reset, but not a power cycle

void copy(std::uint32_t* to, const std::uint32_t* end, const std::uint32_t* from) {
    while (to != end) *to++ = *from++;
}

void fill(std::uint32_t* to, const std::uint32_t* end, std::uint32_t value) {
    while (to != end) *to++ = value;
}

} // namespace

std::uint8_t countWatchdogReset() noexcept {
    constexpr std::uint32_t byWatchdog = 1u << 29, forget = 1u << 24;
    resets = (reg(rcc::csr) & byWatchdog) != 0 ? resets + 1 : 0;
    reg(rcc::csr) |= forget;
    return static_cast<std::uint8_t>(resets);
}

std::uint16_t stackFree() noexcept {
    const std::uint32_t* at = &linkStackBottom;
    while (at != &linkStackTop && *at == paint) ++at;
    return static_cast<std::uint16_t>((at - &linkStackBottom) * 4);
}

} // namespace physvib::board

void startUp() {
    using namespace physvib::board;
    reg(core::cpacr) |= 0xFu << 20; // enables the floating-point unit before any function that may use it
    asm volatile("dsb\nisb" ::: "memory");
    std::uint32_t* here;
    asm volatile("mov %0, sp" : "=r"(here));
    fill(&linkStackBottom, here - 16, paint);
    copy(&linkData, &linkDataEnd, &linkDataLoad);
    copy(&linkFast, &linkFastEnd, &linkFastLoad);
    fill(&linkBss, &linkBssEnd, 0);
    work();
    fault();
}

void fault() {
    asm volatile("cpsid i");
    physvib::board::DacBus::silence();
    for (;;) {
    } // until the hardware watchdog restarts the board
}

namespace {

using Handler = void (*)();
constexpr int interrupts = 82; // RM0364 table 30

struct Vectors {
    std::uint32_t* stack;
    std::array<Handler, 15> system;
    std::array<Handler, interrupts> external;
};

constexpr Vectors makeVectors() {
    Vectors v{&linkStackTop, {}, {}};
    v.system.fill(fault);
    v.external.fill(fault); // among them the brown-out detector's
    v.system[0] = startUp;
    v.external[physvib::board::irq::usart1] = serialInterrupt;
    v.external[physvib::board::irq::usart2] = serialInterrupt;
    v.external[physvib::board::irq::tim6] = sampleTimerInterrupt;
    return v;
}

} // namespace

__attribute__((section(".vectors"), used)) constinit const Vectors vectors = makeVectors();
