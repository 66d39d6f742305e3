// SPDX-License-Identifier: GPL-3.0-or-later
// Renders the tasks of a sweep as `physvib render` does, and stores their results.
#pragma once
#include "CommandLine/Sweep/SweepFolder.h"
#include "CommandLine/Sweep/SweepPlan.h"
#include <string>

namespace physvib {

/// Every `parts`-th task, starting with task `number` (from 1): the share of one of several processes.
struct SweepPart {
    std::uint64_t number = 1, parts = 1;
};

struct SweepTally {
    std::uint64_t rendered = 0, failed = 0;
    std::string fault; ///< call and error of the first failed task
};

/// Renders the tasks that `folder` lacks, one after another, and waits for those that other processes are
/// rendering. Message thread only.
SweepTally runSweepTasks(const SweepPlan& plan, const SweepFolder& folder, const SweepPart& part);

} // namespace physvib
