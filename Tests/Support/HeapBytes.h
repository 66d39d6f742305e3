// SPDX-License-Identifier: MIT
// How much of the heap is in use, as glibc counts it: all threads, also what lies in pages of its own.
#pragma once
#include "Support/Sanitizers.h"
#include <cstddef>
#if defined(__GLIBC__) && !defined(PHYSVIB_ADDRESS_SANITIZER) && !defined(PHYSVIB_THREAD_SANITIZER)
#define PHYSVIB_COUNTS_HEAP
#include <malloc.h>
#endif

namespace physvib::test {

#if defined(PHYSVIB_COUNTS_HEAP)
constexpr bool countsHeap = true;
inline std::size_t heapBytes() noexcept {
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
}
#else
constexpr bool countsHeap = false;
inline std::size_t heapBytes() noexcept { return 0; }
#endif

} // namespace physvib::test
