// SPDX-License-Identifier: MIT
// Every two levels of each factor against each other.
#pragma once
#include "Lab/Statistics/LongTable.h"
#include "Lab/Statistics/TestReport.h"

namespace physvib {

enum class PairTest {
    student, ///< paired t within participants [mean difference / its deviation]; Welch's t between groups
             ///< [Cohen's d, variances averaged]
    ranks    ///< signed ranks within, rank sums between [rank-biserial r]
};

/// Levels of a within-factor are compared over the means of all other factors; groups over the means of each
/// participant. All lines are one family for the correction. Any thread (allocates).
TestReport pairs(const Design& design, PairTest test, Correction correction);

} // namespace physvib
