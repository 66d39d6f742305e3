// SPDX-License-Identifier: MIT
// Mean, standard deviation and confidence interval of values over participants.
#pragma once
#include "Lab/Statistics/Distributions.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

/// Median (mean of the two middle values if the count is even); 0 if empty. Any thread.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

struct Moments {
    std::size_t n = 0;
    double mean = 0.0;
    double deviation = 0.0; ///< sample standard deviation; 0 for fewer than two values
    /// Any thread.
    explicit Moments(std::span<const double> values) noexcept
        : n{values.size()} {
        for (const double v : values) mean += v / static_cast<double>(n);
        for (const double v : values) deviation += (v - mean) * (v - mean);
        deviation = n > 1 ? std::sqrt(deviation / static_cast<double>(n - 1)) : 0.0;
    }
    /// Of the mean; 0 for fewer than two values.
    double standardError() const noexcept {
        return n > 1 ? deviation / std::sqrt(static_cast<double>(n)) : 0.0;
    }
    /// Half of the 95 % interval by Student's t; 0 for fewer than two values.
    double halfInterval() const {
        return n > 1 ? studentQuantile(0.975, static_cast<double>(n - 1)) * standardError() : 0.0;
    }
    double least() const { return mean - halfInterval(); }
    double most() const { return mean + halfInterval(); }
};

} // namespace physvib
