// SPDX-License-Identifier: GPL-3.0-or-later
// Tasks rendered, each by the road of `physvib render`, and kept.
#pragma once
#include "CommandLine/Sweep/SweepFolder.h"
#include "CommandLine/Sweep/SweepJob.h"
#include "CommandLine/Sweep/SweepPlan.h"
#include <string>

namespace physvib {

struct SweepTally {
    std::uint64_t rendered = 0, failed = 0;
    std::string fault; ///< of the first that failed: its call, and why
};

/// Renders what `folder` does not have yet, one task after the other, and waits for what other programs are
/// rendering in it. M only.
SweepTally runSweepTasks(const SweepPlan& plan, const SweepFolder& folder, const SweepPart& part);

} // namespace physvib
