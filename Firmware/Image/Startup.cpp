// SPDX-License-Identifier: MIT
// Start-up from reset to main: memory, floating-point unit, marks on the unused stack, vectors. A processor
// fault silences the outputs, and the hardware watchdog then restarts the board.
#include "BoardOutputs.h"
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

constexpr std::uint32_t stackPaint = 0xA5C35A3C; // pattern of a word of the stack that was never used
__attribute__((section(".noinit"))) std::uint32_t watchdogResets; // survives a reset, but not a power cycle

void copy(std::uint32_t* to, const std::uint32_t* end, const std::uint32_t* from) {
    while (to != end) *to++ = *from++;
}

void fill(std::uint32_t* to, const std::uint32_t* end, std::uint32_t value) {
    while (to != end) *to++ = value;
}

} // namespace

std::uint8_t countWatchdogReset() noexcept {
    constexpr std::uint32_t watchdogFlag = 1u << 29, clearFlags = 1u << 24;
    watchdogResets = (reg(rcc::csr) & watchdogFlag) != 0 ? watchdogResets + 1 : 0;
    reg(rcc::csr) |= clearFlags;
    return static_cast<std::uint8_t>(watchdogResets);
}

std::uint16_t freeStackBytes() noexcept {
    const std::uint32_t* word = &linkStackBottom;
    while (word != &linkStackTop && *word == stackPaint) ++word;
    return static_cast<std::uint16_t>((word - &linkStackBottom) * 4);
}

} // namespace physvib::board

void startUp() {
    using namespace physvib::board;
    reg(core::cpacr) |= 0xFu << 20; // enables the floating-point unit before any function that may use it
    asm volatile("dsb\nisb" ::: "memory");
    std::uint32_t* stackPointer;
    asm volatile("mov %0, sp" : "=r"(stackPointer));
    fill(&linkStackBottom, stackPointer - 16, stackPaint);
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
constexpr int interruptCount = 82; // RM0364 table 30

struct Vectors {
    std::uint32_t* stack;
    std::array<Handler, 15> system;
    std::array<Handler, interruptCount> external;
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
