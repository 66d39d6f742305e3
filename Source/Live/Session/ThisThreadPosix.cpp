// SPDX-License-Identifier: MIT
// Thread priority on POSIX, by the round-robin scheduler, and processor time.
#if !defined(_WIN32)
#include "Live/Session/ThisThread.h"
#include <pthread.h>
#include <sched.h>
#include <time.h>
#include <unistd.h>

namespace physvib {

void raiseThreadPriority(bool isAudio) noexcept {
    // half of the range, as other programs that play sound: below the threads of audio servers
    const int lowest = sched_get_priority_min(SCHED_RR), highest = sched_get_priority_max(SCHED_RR);
    sched_param wanted{};
    wanted.sched_priority = (lowest + highest) / 2 - (isAudio ? 0 : 1);
    pthread_setschedparam(pthread_self(), SCHED_RR, &wanted); // fails without the privilege
}

bool areDriversBoundToTheirThread() noexcept { return false; }

double threadSeconds() noexcept {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int thisProcess() noexcept { return getpid(); }

} // namespace physvib
#endif
