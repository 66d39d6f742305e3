// SPDX-License-Identifier: MIT
// Mean, spread and interval of values over participants.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

/// Of values, whatever their signs; 0 of none. Any thread.
double largestMagnitude(std::span<const double> values) noexcept;

/// The middle value, or the mean of the two in the middle; 0 of none. Any thread.
double median(std::vector<double> values);

struct Moments {
    std::size_t n = 0;
    double mean = 0.0;
    double deviation = 0.0; ///< sample standard deviation; 0 of fewer than two
    /// Any thread.
    explicit Moments(std::span<const double> values) noexcept;
    double standardError() const noexcept; ///< of the mean; 0 of fewer than two
    double halfInterval() const;           ///< 95 %, by Student's t; 0 of fewer than two
};

} // namespace physvib
