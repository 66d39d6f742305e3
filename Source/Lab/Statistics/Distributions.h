// SPDX-License-Identifier: MIT
// Probabilities and quantiles of test statistics under their null hypotheses.
#pragma once
#include <cstddef>

namespace physvib {

// Any thread. Preconditions: finite arguments; degrees of freedom > 0, not necessarily integers.
double fUpper(double f, double df1, double df2);       ///< upper tail of Fisher's F at `f` >= 0
double chiSquaredUpper(double x, double df);           ///< upper tail at `x` >= 0
double studentTwoSided(double t, double df);           ///< two-sided tail beyond |t|
double studentQuantile(double probability, double df); ///< 0 < probability < 1
double normalUpper(double z);
double normalQuantile(double probability);

/// Exact two-sided p of Wilcoxon's V for `n` differences without ties or zeros (R's 2 psignrank). Any thread
/// (allocates).
double signedRankTwoSided(double v, std::size_t n);

/// Exact two-sided p of Mann and Whitney's W for `m` and `n` values without ties (R's 2 pwilcox). Any thread
/// (allocates).
double rankSumTwoSided(double w, std::size_t m, std::size_t n);

} // namespace physvib
