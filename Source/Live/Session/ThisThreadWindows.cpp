// SPDX-License-Identifier: MIT
// Thread priority on Windows, and processor time, in steps of 100 ns.
#if defined(_WIN32)
#include "Io/Disk/SystemWindows.h"
#include "Live/Session/ThisThread.h"

namespace physvib {

void raiseThreadPriority(bool isAudio) noexcept {
    SetThreadPriority(GetCurrentThread(), isAudio ? THREAD_PRIORITY_TIME_CRITICAL : THREAD_PRIORITY_HIGHEST);
}

// they need the COM apartment of that thread
bool areDriversBoundToTheirThread() noexcept { return true; }

double threadSeconds() noexcept {
    const auto secondsOf = [](const FILETIME& time) {
        return 1e-7 * (4294967296.0 * time.dwHighDateTime + time.dwLowDateTime);
    };
    FILETIME begun{}, ended{}, inKernel{}, inUser{};
    GetThreadTimes(GetCurrentThread(), &begun, &ended, &inKernel, &inUser);
    return secondsOf(inKernel) + secondsOf(inUser);
}

int thisProcess() noexcept { return static_cast<int>(GetCurrentProcessId()); }

} // namespace physvib
#endif
