// SPDX-License-Identifier: MIT
// Thread priority on Windows.
#if defined(_WIN32)
#include "Io/Disk/SystemWindows.h"
#include "Live/Devices/ThisThread.h"

namespace physvib {

void raiseThreadPriority() noexcept { SetThreadPriority(GetCurrentThread(), THREAD_PRIORITY_TIME_CRITICAL); }

// they need the COM apartment of that thread
bool areDriversBoundToTheirThread() noexcept { return true; }

int thisProcess() noexcept { return static_cast<int>(GetCurrentProcessId()); }

} // namespace physvib
#endif
