// SPDX-License-Identifier: MIT
// A chart's numeric axis: range, ticks and tick labels.
#pragma once
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace physvib {

struct ChartAxis {
    double least = 0.0, most = 1.0;
    bool isLogarithmic = false;  ///< then both > 0
    std::vector<double> ticks{}; ///< from low to high, within the range
    std::vector<std::string> tickWords{};

    /// From 0 at `least` to 1 at `most`; other values lie outside of that. Any thread.
    double share(double value) const noexcept {
        if (!isLogarithmic) return (value - least) / (most - least);
        return std::log(value / least) / std::log(most / least);
    }

    /// An axis with round ticks that covers `least` to `most`; equal ends are spread. Any thread (allocates).
    static ChartAxis around(double least, double most, int aboutTicks = 5) {
        if (!(most - least > 1e-12 * std::max(std::abs(least), std::abs(most)))) {
            const double spread = std::max(1.0, std::abs(least) * 0.1);
            least -= spread;
            most += spread;
        }
        const double raw = (most - least) / aboutTicks, power = std::pow(10.0, std::floor(std::log10(raw)));
        const double step = raw <= power * 1.0001   ? power
                            : raw <= 2.0001 * power ? 2.0 * power
                            : raw <= 5.0001 * power ? 5.0 * power
                                                    : 10.0 * power;
        const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step * 1.0001))), 0, 9);
        const double first = std::floor(least / step + 1e-9), last = std::ceil(most / step - 1e-9);
        ChartAxis axis{first * step, last * step};
        for (double k = first; k <= last + 0.5; ++k) {
            axis.ticks.push_back(k * step);
            axis.tickWords.push_back(fixedNumber(k * step, decimals));
        }
        return axis;
    }
    static ChartAxis logarithmic(double least, double most) {
        ChartAxis axis{least / 1.15, most * 1.15, true, {}};
        const bool isWide = axis.most / axis.least > 300.0;
        for (int power = static_cast<int>(std::floor(std::log10(axis.least)));
             power <= static_cast<int>(std::ceil(std::log10(axis.most))); ++power)
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double tick = digit * std::pow(10.0, power);
                if (tick < axis.least || tick > axis.most || (isWide && digit != 1.0)) continue;
                axis.ticks.push_back(tick);
                axis.tickWords.push_back(fixedNumber(tick, std::max(0, -power)));
            }
        return axis;
    }
};

} // namespace physvib
