// SPDX-License-Identifier: GPL-3.0-or-later
// Times on machines that others use too: a thread's own processor time, medians, ratios by turns.
#pragma once
#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace physvib::bench {

/// Processor time of this thread, in seconds: others that use the machine meanwhile disturb less.
inline double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1.0e-9 * static_cast<double>(time.tv_nsec);
}

template <class Do>
double secondsOf(Do work) {
    const double start = now();
    work();
    return now() - start;
}

/// The value below which `part` (0 to 1) of them lie; their order is lost.
inline double quantile(std::vector<double>& values, double part) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

inline double median(std::vector<double>& values) { return quantile(values, 0.5); }

} // namespace physvib::bench
