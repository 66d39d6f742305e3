// SPDX-License-Identifier: MIT
// Quantiles of Student's and the normal distribution.
#pragma once
namespace physvib {

// Any thread. Preconditions: 0 < probability < 1; degrees of freedom > 0, not necessarily integers.
double studentQuantile(double probability, double df);
double normalQuantile(double probability);

} // namespace physvib
