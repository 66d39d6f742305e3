// SPDX-License-Identifier: MIT
// Windows' own header, for the files that are its alone: without sockets of old, and without macros named min
// and max.
#pragma once
#if defined(_WIN32)
#if !defined(WIN32_LEAN_AND_MEAN)
#define WIN32_LEAN_AND_MEAN
#endif
#if !defined(NOMINMAX)
#define NOMINMAX
#endif
#include <windows.h>
#endif
