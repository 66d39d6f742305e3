// SPDX-License-Identifier: MIT
// An axis of numbers: its range, its ticks, their words.
#pragma once
#include <string>
#include <vector>

namespace physvib {

struct ChartAxis {
    double least = 0.0, most = 1.0;
    bool isLogarithmic = false;  ///< then both > 0
    std::vector<double> ticks{}; ///< from low to high, within the range
    std::vector<std::string> tickWords{};

    /// From 0 at `least` to 1 at `most`; what is beyond stays beyond. Any thread.
    double share(double value) const noexcept;

    /// Round ticks around all of `least` to `most`; equal ends are spread. Any thread (allocates).
    static ChartAxis around(double least, double most, int aboutTicks = 5);
    static ChartAxis logarithmic(double least, double most);
};

} // namespace physvib
