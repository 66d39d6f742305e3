// SPDX-License-Identifier: MIT
// Two-pass mean and variance, accurate for values far from 0 with a small spread.
#include "Lab/Statistics/Moments.h"
#include "Lab/Statistics/Distributions.h"
#include <algorithm>
#include <cmath>

namespace physvib {

double largestMagnitude(std::span<const double> values) noexcept {
    double largest = 0.0;
    for (const double v : values) largest = std::max(largest, std::abs(v));
    return largest;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Moments::Moments(std::span<const double> values) noexcept
    : n{values.size()} {
    for (const double v : values) mean += v / static_cast<double>(n);
    for (const double v : values) deviation += (v - mean) * (v - mean);
    deviation = n > 1 ? std::sqrt(deviation / static_cast<double>(n - 1)) : 0.0;
}

double Moments::standardError() const noexcept {
    return n > 1 ? deviation / std::sqrt(static_cast<double>(n)) : 0.0;
}

double Moments::halfInterval() const {
    return n > 1 ? studentQuantile(0.975, static_cast<double>(n - 1)) * standardError() : 0.0;
}

} // namespace physvib
