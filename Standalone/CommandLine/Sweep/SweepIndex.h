// SPDX-License-Identifier: GPL-3.0-or-later
// All tasks as one table, in their order: the same bytes whoever did them, and when.
#pragma once
#include "CommandLine/Sweep/SweepFolder.h"
#include "CommandLine/Sweep/SweepPlan.h"
#include <string>

namespace physvib {

/// Tasks that are not done.
struct SweepGap {
    std::uint64_t tasks = 0;
    std::string first; ///< the call of one of them
};

/// Those of `plan` that `folder` does not have. M only.
SweepGap findGap(const SweepPlan& plan, const SweepFolder& folder);

/// Writes the index of a sweep without a gap; empty, or one line. M only.
std::string writeIndex(const SweepPlan& plan, const SweepFolder& folder);

} // namespace physvib
