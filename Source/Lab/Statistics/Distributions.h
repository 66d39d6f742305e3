// SPDX-License-Identifier: MIT
// Probabilities of test statistics under their null hypotheses.
#pragma once
#include <cstddef>

namespace physvib {

// Any thread. Arguments are finite, degrees of freedom > 0 and need not be whole.
double fUpper(double f, double df1, double df2);       ///< of Fisher's F, above `f` >= 0
double chiSquaredUpper(double x, double df);           ///< above `x` >= 0
double studentTwoSided(double t, double df);           ///< farther from 0 than |t|
double studentQuantile(double probability, double df); ///< 0 < probability < 1
double normalUpper(double z);
double normalQuantile(double probability);

/// Wilcoxon's V of `n` differences without ties or zeros: as far from its middle as this, exactly (R's 2
/// psignrank). Any thread (allocates).
double signedRankTwoSided(double v, std::size_t n);

/// Mann and Whitney's W of `m` and `n` values without ties, exactly (R's 2 pwilcox). Any thread (allocates).
double rankSumTwoSided(double w, std::size_t m, std::size_t n);

} // namespace physvib
