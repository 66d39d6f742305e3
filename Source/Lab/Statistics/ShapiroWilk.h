// SPDX-License-Identifier: MIT
// Shapiro-Wilk test of normality over participants (thesis 3.1.1).
#pragma once
#include "Lab/Statistics/LongTable.h"
#include "Lab/Statistics/TestReport.h"
#include <span>

namespace physvib {

constexpr std::size_t fewestForShapiro = 3, mostForShapiro = 5000;

/// W and p (Royston 1995, AS R94). Preconditions: fewestForShapiro to mostForShapiro values, not all equal.
/// Any thread (allocates).
TestLine shapiroWilk(std::span<const double> values);

/// A line per combination of levels and group. Any thread (allocates).
TestReport shapiroByCell(const Design& design);

} // namespace physvib
