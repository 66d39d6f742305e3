// SPDX-License-Identifier: MIT
// Rules of the render thread: a marker for functions that never block, and a guard against denormal numbers.
#pragma once
#include <cstdint>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

/// Stands after a function's noexcept. clang 20 and later can check it: at run time with RealtimeSanitizer
/// (Tests/Realtime/rtsan.sh), in part already while compiling. For other compilers it is empty.
#if defined(__clang__) && defined(__has_cpp_attribute)
#if __has_cpp_attribute(clang::nonblocking)
#define PHYSVIB_NONBLOCKING [[clang::nonblocking]]
#endif
#endif
#ifndef PHYSVIB_NONBLOCKING
#define PHYSVIB_NONBLOCKING
#endif

namespace physvib {
/// Sets flush-to-zero (and denormals-are-zero) for this thread, so that decaying tails cost no more than
/// others, and restores the earlier mode when destroyed. If the mode is already set, it does not write it:
/// writing stalls until all arithmetic under way has finished. Render thread (R), wait-free.
class DenormalGuard {
public:
    DenormalGuard() noexcept
        : saved_{read()} {
        if (!isSet()) write(saved_ | flushBits);
    }
    ~DenormalGuard() {
        if (!isSet()) write(saved_);
    }
    DenormalGuard(const DenormalGuard&) = delete;
    DenormalGuard& operator=(const DenormalGuard&) = delete;

private:
#if defined(__SSE__)
    using Mode = unsigned int;
    static constexpr Mode flushBits = 0x8040; // FTZ, DAZ (Intel SDM vol. 1, 10.2.3)
    static Mode read() noexcept { return _mm_getcsr(); }
    static void write(Mode mode) noexcept { _mm_setcsr(mode); }
#elif defined(__aarch64__)
    using Mode = std::uint64_t;
    static constexpr Mode flushBits = Mode{1} << 24; // FPCR.FZ (Arm ARM)
    static Mode read() noexcept {
        Mode mode;
        asm volatile("mrs %0, fpcr" : "=r"(mode));
        return mode;
    }
    static void write(Mode mode) noexcept { asm volatile("msr fpcr, %0" ::"r"(mode)); }
#elif defined(__ARM_FP)
    using Mode = std::uint32_t;
    static constexpr Mode flushBits = Mode{1} << 24; // FPSCR.FZ (ARMv7-M ARM)
    static Mode read() noexcept {
        Mode mode;
        asm volatile("vmrs %0, fpscr" : "=r"(mode));
        return mode;
    }
    static void write(Mode mode) noexcept { asm volatile("vmsr fpscr, %0" ::"r"(mode)); }
#elif defined(__wasm__)
    using Mode = std::uint32_t;
    static constexpr Mode flushBits = 0; // WebAssembly keeps denormals; tails end at retireDecibels, above
    static Mode read() noexcept { return 0; }
    static void write(Mode) noexcept {}
#else
#error "say here how this machine flushes denormals"
#endif
    bool isSet() const noexcept { return (saved_ & flushBits) == flushBits; }
    Mode saved_; // the mode before this guard
};
} // namespace physvib
