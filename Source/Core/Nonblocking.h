// SPDX-License-Identifier: MIT
// Macro that marks functions of the render thread: they neither allocate, free, lock, wait nor make system
// calls.
#pragma once

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
