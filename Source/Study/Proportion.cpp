// SPDX-License-Identifier: MIT
// Wilson's interval; binomial tails by logarithms, so that thousands of trials do not underflow.
#include "Study/Proportion.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace physvib {

Proportion proportion(std::uint64_t hits, std::uint64_t trials) noexcept {
    Proportion result{hits, trials};
    if (trials == 0) return result;
    constexpr double z = 1.959963984540054; // 97.5 % point of the normal distribution
    const auto n = static_cast<double>(trials);
    const double p = static_cast<double>(hits) / n;
    const double middle = p + z * z / (2.0 * n), half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
    const double scale = 1.0 + z * z / n;
    result.share = p;
    result.least = std::max(0.0, (middle - half) / scale);
    result.most = std::min(1.0, (middle + half) / scale);
    return result;
}

double signTestP(std::uint64_t hits, std::uint64_t trials) noexcept {
    const std::uint64_t fewer = std::min(hits, trials - hits);
    if (2 * fewer == trials) return 1.0;
    const auto n = static_cast<double>(trials);
    double tail = 0.0, logTerm = -n * std::numbers::ln2; // of C(n, k) / 2^n, from k = 0 on
    for (std::uint64_t k = 0; k <= fewer; ++k) {
        tail += std::exp(logTerm);
        logTerm += std::log((n - static_cast<double>(k)) / static_cast<double>(k + 1));
    }
    return std::min(1.0, 2.0 * tail);
}

} // namespace physvib
