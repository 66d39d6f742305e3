// SPDX-License-Identifier: MIT
// Thread processor time on Windows, by GetThreadTimes, in steps of 100 ns.
#if defined(_WIN32)
#include "Io/Disk/SystemWindows.h"
#include "Live/Session/ThreadTime.h"

namespace physvib {

double threadSeconds() noexcept {
    const auto secondsOf = [](const FILETIME& time) {
        return 1e-7 * (4294967296.0 * time.dwHighDateTime + time.dwLowDateTime);
    };
    FILETIME begun{}, ended{}, inKernel{}, inUser{};
    GetThreadTimes(GetCurrentThread(), &begun, &ended, &inKernel, &inUser);
    return secondsOf(inKernel) + secondsOf(inUser);
}

} // namespace physvib
#endif
