// SPDX-License-Identifier: MIT
// Proportion of trials with its confidence interval.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace physvib {

struct Proportion {
    std::uint64_t hits = 0, trials = 0;
    double share = 0.0;             ///< hits / trials; 0 without a trial
    double least = 0.0, most = 1.0; ///< 95 % confidence interval (Wilson 1927), assuming independent trials
};

/// `hits` <= `trials`. Any thread.
inline Proportion proportion(std::uint64_t hits, std::uint64_t trials) noexcept {
    Proportion result{hits, trials};
    if (trials == 0) return result;
    constexpr double z = 1.959963984540054; // 97.5 % quantile of the normal distribution
    const auto n = static_cast<double>(trials);
    const double p = static_cast<double>(hits) / n;
    const double middle = p + z * z / (2.0 * n),
                 half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
    const double scale = 1.0 + z * z / n;
    result.share = p;
    result.least = std::max(0.0, (middle - half) / scale);
    result.most = std::min(1.0, (middle + half) / scale);
    return result;
}

} // namespace physvib
