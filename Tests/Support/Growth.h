// SPDX-License-Identifier: MIT
// Memory and time of what goes on for hours of simulated time. Memory is asserted, times are told: of this
// thread's processor time, and the least of runs side by side that do the same, so that a step that is slow
// is so by itself.
#pragma once
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <gtest/gtest.h>
#include <malloc.h>
#include <string>
#include <vector>

namespace physvib::test {

/// How long the long tests simulate; one hour at least, of which nothing is asserted.
inline double hoursWanted() {
    const char* const hours = std::getenv("PHYSVIB_HOURS");
    return hours != nullptr ? std::atof(hours) : 10.0;
}

/// What the program has asked for and not given back; what the system holds beside that varies.
inline double memoryMb() {
    const auto now = mallinfo2();
    return static_cast<double>(now.uordblks + now.hblkhd) / 1e6;
}

/// Of a clock of the system.
inline double microsecondsOf(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Steps, hour by hour.
class Growth {
public:
    explicit Growth(std::string what)
        : what_{std::move(what)} {
        microseconds_.reserve(1'000'000);
        hours_.reserve(1000);
    }

    /// Each of them does the same.
    template <class... Steps>
    void step(double simulatedSeconds, Steps... steps) {
        if (simulatedSeconds >= 3600.0 * static_cast<double>(hours_.size() + 1)) endHour();
        microseconds_.push_back(static_cast<float>(std::min({timed(steps)...})));
    }

    void expectFlat() {
        endHour();
        for (std::size_t h = 1; h < hours_.size(); ++h)
            EXPECT_LT(hours_[h] - hours_[0], 1.0)
                << "MB more than after the first hour, after hour " << h + 1;
    }

private:
    template <class Step>
    static double timed(Step& step) {
        const double before = microsecondsOf(CLOCK_THREAD_CPUTIME_ID);
        step();
        return microsecondsOf(CLOCK_THREAD_CPUTIME_ID) - before;
    }
    void endHour() {
        auto& sorted = microseconds_;
        if (sorted.empty()) return;
        std::ranges::sort(sorted);
        const float median = sorted[sorted.size() / 2];
        const auto slow = sorted.end() - std::ranges::upper_bound(sorted, 2 * median);
        const std::size_t count = sorted.size();
        const float p99 = sorted[count * 99 / 100], most = sorted.back();
        sorted.clear();
        hours_.push_back(memoryMb());
        std::printf("%s: hour %zu: %.2f MB; a step %.1f us (median), %.1f (99 %%), %.1f (most), %.3f %% "
                    "above twice the median\n",
                    what_.c_str(), hours_.size(), hours_.back(), median, p99, most,
                    100.0 * static_cast<double>(slow) / static_cast<double>(count));
        std::fflush(stdout);
    }

    std::string what_;
    std::vector<float> microseconds_;
    std::vector<double> hours_; // MB
};

} // namespace physvib::test
