// SPDX-License-Identifier: MIT
// Dynamic loading on Windows.
#ifdef _WIN32
#include "Live/Pads/SharedLibrary.h"
#include <windows.h>

namespace physvib {

void* openLibrary(const char* name) { return reinterpret_cast<void*>(LoadLibraryA(name)); }
void* functionIn(void* library, const char* name) {
    return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}

} // namespace physvib
#endif
