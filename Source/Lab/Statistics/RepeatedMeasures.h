// SPDX-License-Identifier: MIT
// Analysis of variance with repeated measures: one to three factors within participants, at most one between
// them.
#pragma once
#include "Lab/Statistics/LongTable.h"
#include "Lab/Statistics/TestReport.h"

namespace physvib {

/// F of every main effect and interaction, each against its own error: univariate, Type III sums of squares
/// (groups of any size count alike). With Mauchly's test, Greenhouse and Geisser's epsilon (pCorrected is its
/// p; of effects between participants it is p itself), Huynh and Feldt's, and generalised eta squared
/// (Olejnik and Algina 2003, all factors manipulated): the figures of R's afex::aov_ez. Any thread
/// (allocates).
TestReport repeatedMeasures(const Design& design);

/// The same of aligned ranks (Wobbrock and others 2011), for scores that are only ordered: for each effect,
/// all others are taken off the values, which are then ranked; only that effect of their analysis counts. Any
/// thread (allocates).
TestReport alignedRanks(const Design& design);

} // namespace physvib
