// SPDX-License-Identifier: MIT
// Loads libraries of the system at run time: a program starts without them, and runs where they are missing.
#pragma once

namespace physvib {

/// System calls: opens the library of that name, and finds a function in it; or null. Any thread.
void* openLibrary(const char* name);
void* functionIn(void* library, const char* name);

} // namespace physvib
