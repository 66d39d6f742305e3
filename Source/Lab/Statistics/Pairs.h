// SPDX-License-Identifier: MIT
// Pairwise comparisons of the levels of each factor.
#pragma once
#include "Lab/Statistics/LongTable.h"
#include "Lab/Statistics/TestReport.h"

namespace physvib {

enum class PairTest {
    student, ///< paired t within participants [mean difference / its standard deviation]; Welch's t between
             ///< groups [Cohen's d with averaged variances]
    ranks    ///< signed-rank test within, rank-sum test between [rank-biserial r]
};

/// Levels of a within-factor are compared by means over all other factors, groups by the means of each
/// participant. The correction treats all lines as one family. Any thread (allocates).
TestReport pairs(const Design& design, PairTest test, Correction correction);

} // namespace physvib
