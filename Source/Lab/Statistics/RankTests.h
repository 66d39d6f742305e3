// SPDX-License-Identifier: MIT
// Tests of ranks over participants, exact where R's defaults are.
#pragma once
#include "Lab/Statistics/LongTable.h"
#include "Lab/Statistics/TestReport.h"
#include <span>

namespace physvib {

// A design with several within-factors is tested factor by factor, each a line, over the means of the others.
// Effect sizes in brackets. Any thread (allocates).

TestReport friedman(const Design& design); ///< two or more levels [Kendall's W]
TestReport wilcoxon(const Design& design); ///< signed ranks of two levels, first minus second [matched-pairs
                                           ///< rank-biserial r]
TestReport mannWhitney(const Design& design); ///< two groups, one value per participant [rank-biserial r]
/// two or more groups [eta squared of H, which may be below 0]
TestReport kruskalWallis(const Design& design);

/// Signed ranks of `differences`: exact below 50 without ties and zeros, else normal with continuity
/// correction; zeros are left out. Its statistic is none if all are zero.
TestLine signedRank(std::span<const double> differences);

/// Rank sum of the first sample: exact below 50 each without ties. Its statistic is none if all values are
/// equal.
TestLine rankSum(std::span<const double> first, std::span<const double> second);

} // namespace physvib
