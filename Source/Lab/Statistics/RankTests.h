// SPDX-License-Identifier: MIT
// Rank tests over participants, with exact p values where R's defaults are exact.
#pragma once
#include "Lab/Statistics/LongTable.h"
#include "Lab/Statistics/TestReport.h"
#include <span>

namespace physvib {

// With several within-factors, each is tested separately on means over the others and gives one line. Effect
// sizes in brackets. Any thread (allocates).

TestReport friedman(const Design& design);    ///< two or more levels [Kendall's W]
TestReport wilcoxon(const Design& design);    ///< signed-rank test of two levels, first minus second
                                              ///< [matched-pairs rank-biserial r]
TestReport mannWhitney(const Design& design); ///< two groups, one value per participant [rank-biserial r]
/// two or more groups [eta squared of H, which may be below 0]
TestReport kruskalWallis(const Design& design);

/// Signed-rank test of `differences`, without zeros. Exact below 50 values without ties and zeros, else
/// normal with continuity correction. Without a statistic if all differences are zero.
TestLine signedRank(std::span<const double> differences);

/// Rank-sum test of the first sample. Exact below 50 values each without ties. Without a statistic if all
/// values are equal.
TestLine rankSum(std::span<const double> first, std::span<const double> second);

} // namespace physvib
