// SPDX-License-Identifier: GPL-3.0-or-later
// Index of all tasks in one table, in task order. Its bytes do not depend on the workers or the time.
#pragma once
#include "CommandLine/Sweep/SweepFolder.h"
#include "CommandLine/Sweep/SweepPlan.h"
#include <string>

namespace physvib {

/// Tasks that are not done.
struct SweepGap {
    std::uint64_t tasks = 0;
    std::string first; ///< the call of the first one
};

/// The tasks of `plan` that `folder` lacks. Message thread only.
SweepGap findGap(const SweepPlan& plan, const SweepFolder& folder);

/// Writes the index of a complete sweep; empty, or one error line. Message thread only.
std::string writeIndex(const SweepPlan& plan, const SweepFolder& folder);

} // namespace physvib
