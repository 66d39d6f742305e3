// SPDX-License-Identifier: MIT
// Wilson's confidence interval of a proportion.
#include "Lab/Study/Proportion.h"
#include <algorithm>
#include <cmath>

namespace physvib {

Proportion proportion(std::uint64_t hits, std::uint64_t trials) noexcept {
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
