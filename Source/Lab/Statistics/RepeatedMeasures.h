// SPDX-License-Identifier: MIT
// Repeated-measures analysis of variance: one to three within-participant factors, at most one
// between-participant factor.
#pragma once
#include "Lab/Statistics/LongTable.h"
#include "Lab/Statistics/TestReport.h"

namespace physvib {

/// Univariate F test of every main effect and interaction against its own error, with Type III sums of
/// squares (groups have equal weights). The report has Mauchly's test, Greenhouse and Geisser's epsilon
/// (pCorrected is its p; for between effects it equals p), Huynh and Feldt's epsilon, and generalised eta
/// squared (Olejnik and Algina 2003, all factors manipulated). The results equal those of R's afex::aov_ez.
/// Any thread (allocates).
TestReport repeatedMeasures(const Design& design);

/// The same for aligned ranks (Wobbrock and others 2011), for ordinal scores. For each effect, the other
/// effects are subtracted from the values, which are then ranked; only the line of that effect is used. Any
/// thread (allocates).
TestReport alignedRanks(const Design& design);

} // namespace physvib
