// SPDX-License-Identifier: MIT
// Thresholds of several observers' QUEST+ runs: what the runs say together about the width of the
// psychometric function replaces the uniform prior of each.
#pragma once
#include "Lab/Statistics/Psychometric.h"
#include "Lab/Statistics/QuestPlus.h"
#include <span>
#include <vector>

namespace physvib {

struct PooledThresholds {
    std::vector<double> thresholds; ///< posterior mean of each run
    double deviation = 0.0; ///< posterior standard deviation of their mean that is due to the widths: an
                            ///< error of all runs alike, which does not show in their spread
};

/// Each run is its answers by level (any order). All runs have the plan. Precondition: every list of `plan`
/// and `runs` has at least one entry. Any thread (allocates).
PooledThresholds pooledThresholds(const QuestPlan& plan, std::span<const std::vector<LevelCount>> runs);

} // namespace physvib
