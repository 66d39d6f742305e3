// SPDX-License-Identifier: MIT
// Continuous distributions from Boost.Math; exact rank distributions by counting, with positive terms only.
#include "Lab/Statistics/Distributions.h"
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>
#include <vector>

namespace physvib {
namespace {

/// Two-sided probability of a discrete symmetric distribution: twice the smaller tail, `at` included.
double twiceTheTail(const std::vector<double>& probabilities, double at) {
    const auto middle = 0.5 * static_cast<double>(probabilities.size() - 1);
    // by symmetry, sum the tail from 0
    const auto fromEnd = static_cast<std::size_t>(std::lround(at > middle ? 2.0 * middle - at : at));
    double tail = 0.0;
    for (std::size_t i = 0; i <= fromEnd; ++i) tail += probabilities[i];
    return std::min(1.0, 2.0 * tail);
}

} // namespace

double fUpper(double f, double df1, double df2) {
    return boost::math::ibeta(0.5 * df2, 0.5 * df1, df2 / (df2 + df1 * f));
}

double chiSquaredUpper(double x, double df) { return boost::math::gamma_q(0.5 * df, 0.5 * x); }

double studentTwoSided(double t, double df) { return fUpper(t * t, 1.0, df); }

double studentQuantile(double probability, double df) {
    return boost::math::quantile(boost::math::students_t{df}, probability);
}

double normalUpper(double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

double normalQuantile(double probability) {
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * probability);
}

double signedRankTwoSided(double v, std::size_t n) {
    std::vector<double> probabilities(n * (n + 1) / 2 + 1);
    probabilities[0] = 1.0;
    std::size_t most = 0;
    for (std::size_t rank = 1; rank <= n; ++rank) {
        most += rank;
        for (std::size_t sum = most + 1; sum-- > 0;)
            probabilities[sum] =
                0.5 * probabilities[sum] + (sum >= rank ? 0.5 * probabilities[sum - rank] : 0.0);
    }
    return twiceTheTail(probabilities, v);
}

double rankSumTwoSided(double w, std::size_t m, std::size_t n) {
    // Recursion: the largest of all values is one of the m with probability m / (m + n), and then exceeds all
    // n.
    std::vector<std::vector<double>> row(n + 1, std::vector<double>{1.0});
    for (std::size_t i = 1; i <= m; ++i) {
        row[0] = {1.0};
        for (std::size_t j = 1; j <= n; ++j) {
            const double share = static_cast<double>(i) / static_cast<double>(i + j);
            std::vector<double> next(i * j + 1);
            for (std::size_t u = 0; u < row[j].size(); ++u) next[u + j] += share * row[j][u];
            for (std::size_t u = 0; u < row[j - 1].size(); ++u) next[u] += (1.0 - share) * row[j - 1][u];
            row[j] = std::move(next);
        }
    }
    return twiceTheTail(row[n], w);
}

} // namespace physvib
