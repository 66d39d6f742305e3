// SPDX-License-Identifier: MIT
// Mean, standard deviation and confidence interval of values over participants.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

/// Largest absolute value; 0 for an empty span. Any thread.
double largestMagnitude(std::span<const double> values) noexcept;

/// Median (mean of the two middle values if the count is even); 0 if empty. Any thread.
double median(std::vector<double> values);

struct Moments {
    std::size_t n = 0;
    double mean = 0.0;
    double deviation = 0.0; ///< sample standard deviation; 0 for fewer than two values
    /// Any thread.
    explicit Moments(std::span<const double> values) noexcept;
    double standardError() const noexcept; ///< of the mean; 0 for fewer than two values
    double halfInterval() const; ///< half of the 95 % interval by Student's t; 0 for fewer than two values
};

} // namespace physvib
