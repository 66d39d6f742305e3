// SPDX-License-Identifier: MIT
// The mark of what the render role runs: neither allocates, frees, locks, waits nor calls the system.
#pragma once

/// After a function's noexcept. Compilers that know it (clang 20 and later) can check it: at run time with
/// RealtimeSanitizer (Tests/Realtime/rtsan.sh), in part already while compiling. For others it is empty.
#if defined(__clang__) && defined(__has_cpp_attribute)
#if __has_cpp_attribute(clang::nonblocking)
#define PHYSVIB_NONBLOCKING [[clang::nonblocking]]
#endif
#endif
#ifndef PHYSVIB_NONBLOCKING
#define PHYSVIB_NONBLOCKING
#endif
