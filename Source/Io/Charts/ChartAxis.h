// SPDX-License-Identifier: MIT
// A chart's numeric axis: range, ticks and tick labels.
#pragma once
#include <string>
#include <vector>

namespace physvib {

struct ChartAxis {
    double least = 0.0, most = 1.0;
    bool isLogarithmic = false;  ///< then both > 0
    std::vector<double> ticks{}; ///< from low to high, within the range
    std::vector<std::string> tickWords{};

    /// From 0 at `least` to 1 at `most`; other values lie outside of that. Any thread.
    double share(double value) const noexcept;

    /// An axis with round ticks that covers `least` to `most`; equal ends are spread. Any thread (allocates).
    static ChartAxis around(double least, double most, int aboutTicks = 5);
    static ChartAxis logarithmic(double least, double most);
};

} // namespace physvib
