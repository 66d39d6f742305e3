// SPDX-License-Identifier: MIT
// Whether values over participants may be normal (thesis 3.1.1).
#pragma once
#include "Lab/Statistics/LongTable.h"
#include "Lab/Statistics/TestReport.h"
#include <span>

namespace physvib {

constexpr std::size_t fewestForShapiro = 3, mostForShapiro = 5000;

/// W and p (Royston 1995, AS R94). `values`: fewestForShapiro to mostForShapiro, not all equal. Any thread
/// (allocates).
TestLine shapiroWilk(std::span<const double> values);

/// A line per combination of levels and group. Any thread (allocates).
TestReport shapiroByCell(const Design& design);

} // namespace physvib
