// SPDX-License-Identifier: MIT
// Includes <windows.h> without old sockets and without the macros min and max; for Windows-only files.
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
