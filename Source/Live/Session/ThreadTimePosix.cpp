// SPDX-License-Identifier: MIT
// Thread processor time on POSIX, by clock_gettime.
#if !defined(_WIN32)
#include "Live/Session/ThreadTime.h"
#include <time.h>

namespace physvib {

double threadSeconds() noexcept {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace physvib
#endif
