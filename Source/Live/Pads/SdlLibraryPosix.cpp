// SPDX-License-Identifier: MIT
// Dynamic loading on POSIX systems.
#ifndef _WIN32
#include "Live/Pads/SharedLibrary.h"
#include <dlfcn.h>

namespace physvib {

void* openLibrary(const char* name) { return dlopen(name, RTLD_NOW | RTLD_LOCAL); }
void* functionIn(void* library, const char* name) { return dlsym(library, name); }

} // namespace physvib
#endif
