// SPDX-License-Identifier: MIT
// How much of the heap is in use, as glibc counts it: all threads, also what lies in pages of its own.
#pragma once
#include <cstddef>
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <malloc.h>
#endif

namespace physvib::test {

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) &&                 \
    !defined(PHYSVIB_THREAD_SANITIZER)
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
