// SPDX-License-Identifier: MIT
// 95 % intervals of effect sizes.
#pragma once
#include "Lab/Statistics/TestReport.h"
#include <optional>

namespace physvib {

// Any thread. Without an interval where the distribution cannot be computed.

/// Noncentrality of Student's t by inversion of its distribution; over the root of n, d of a paired test.
std::optional<Interval95> noncentralityOfT(double t, double df);

/// Rank-biserial r on Fisher's scale, from r's variance where there is no effect. None of r = 1 and -1.
std::optional<Interval95> intervalOfR(double r, double variance);

} // namespace physvib
