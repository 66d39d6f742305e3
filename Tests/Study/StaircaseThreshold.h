// SPDX-License-Identifier: MIT
// The threshold that a staircase has come to.
#pragma once
#include "Lab/Study/Experiment.h"
#include <numeric>

namespace physvib::test {

/// Mean level of the later half of the reversals, of which there are two or more.
inline double thresholdDb(const Staircase& stairs) {
    const auto& reversals = stairs.reversals();
    const auto first = reversals.begin() + static_cast<std::ptrdiff_t>(reversals.size() / 2);
    return std::accumulate(first, reversals.end(), 0.0) / static_cast<double>(reversals.end() - first);
}

} // namespace physvib::test
