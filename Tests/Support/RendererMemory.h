// SPDX-License-Identifier: MIT
// The memory that is taken on cache lines, as a renderer's alone is: a test may count it, wait in it, or say
// that there is none. It replaces the program's functions, so one file of a program includes it.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace physvib::test {

/// Is asked before so many bytes are taken; false: there are none. Any thread sets it, whoever takes memory
/// calls it.
inline std::atomic<bool (*)(std::size_t bytes)> beforeMemory{nullptr};

#if defined(PHYSVIB_THREAD_SANITIZER) // it has functions of its own, which cannot be replaced
constexpr bool ownsMemory = false;
#else
constexpr bool ownsMemory = true;

#if defined(_WIN32) // whose aligned memory has functions of its own
inline void* takeAligned(std::size_t grain, std::size_t size) { return _aligned_malloc(size, grain); }
inline void giveAligned(void* memory) { _aligned_free(memory); }
#else
inline void* takeAligned(std::size_t grain, std::size_t size) {
    return std::aligned_alloc(grain, (size + grain - 1) / grain * grain);
}
inline void giveAligned(void* memory) { std::free(memory); }
#endif
#endif

} // namespace physvib::test

#if !defined(PHYSVIB_THREAD_SANITIZER)
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment,
                                     const std::nothrow_t&) noexcept {
    if (auto* const call = physvib::test::beforeMemory.load(); call != nullptr && !call(size)) return nullptr;
    return physvib::test::takeAligned(static_cast<std::size_t>(alignment), size);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    void* const memory = operator new(size, alignment, std::nothrow);
    return memory != nullptr ? memory : throw std::bad_alloc{};
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    physvib::test::giveAligned(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    physvib::test::giveAligned(memory);
}
#endif
