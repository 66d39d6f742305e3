// SPDX-License-Identifier: MIT
// The board's renderer over a fixed random list, and a hash of all its codes and of its last state: built for
// this computer and for QEMU's Cortex-M4F, it must print the same two numbers.
#include "Core/BoardRenderer.h"
#include "Wire/Frames.h"
#include <new>

namespace {

using namespace physvib;

alignas(BoardRenderer) unsigned char memory[sizeof(BoardRenderer)]; // nobody runs constructors here

std::uint32_t random() {
    static std::uint32_t state = 1;
    return (state = state * 1664525u + 1013904223u) >> 8;
}

BoardEvent someEvent(std::uint32_t frame) {
    BoardEvent e;
    e.frame = frame;
    e.frequency16 = static_cast<std::uint16_t>(16 * 30 + (random() % 140) * 53);
    e.decay16 = static_cast<std::uint16_t>(16 * 4 + e.frequency16 % 200);
    e.durationMs = static_cast<std::uint16_t>(random() % 5 == 0 ? 1 + random() % 100 : 0);
    for (auto& a : e.amplitudes) a = static_cast<std::int16_t>(static_cast<int>(random() % 1000) - 500);
    return e;
}

struct Hashes {
    std::uint32_t codes = 0, state = 0;
};

Hashes run(int blocks) {
    Hashes h;
    BoardRenderer::Codes block;
    auto& renderer = *new (memory) BoardRenderer;
    renderer.prepare();
    for (int i = 0; i < blocks; ++i) {
        if (random() % 4 == 0) renderer.schedule(someEvent(renderer.frame() + random() % 40));
        renderer.render(block);
        h.codes = h.codes * 31u + crc16({block[0].data(), sizeof block});
    }
    for (int i = 0; i < renderer.bank().liveModes(); ++i)
        h.state = h.state * 31u + crc16({reinterpret_cast<const std::uint8_t*>(&renderer.bank().mode(i)),
                                         sizeof(PhasorBank::Mode)});
    return h;
}

void writeHex(char* at, std::uint32_t value) {
    for (int i = 0; i < 8; ++i) at[i] = "0123456789abcdef"[value >> (28 - 4 * i) & 15];
}

char text[] = "codes 00000000 state 00000000\n";

const char* result() {
    const Hashes h = run(25'000);
    writeHex(text + 6, h.codes);
    writeHex(text + 21, h.state);
    return text;
}

} // namespace

#ifdef __arm__
extern "C" void start() {
    *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88) |= 0xFu << 20;
    asm volatile("dsb\nisb" ::: "memory");
    const auto semihost = [](std::uint32_t operation, const void* argument) {
        register std::uint32_t r0 asm("r0") = operation;
        register const void* r1 asm("r1") = argument;
        asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    };
    semihost(4, result());                                  // SYS_WRITE0
    semihost(0x18, reinterpret_cast<const void*>(0x20026)); // SYS_EXIT, well
    for (;;) {
    }
}

__attribute__((section(".vectors"), used)) const void* const vectors[] = {
    reinterpret_cast<const void*>(0x20020000), reinterpret_cast<const void*>(start)};
#else
#include <cstdio>
int main() { std::fputs(result(), stdout); }
#endif
