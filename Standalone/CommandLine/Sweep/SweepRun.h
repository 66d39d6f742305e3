// SPDX-License-Identifier: GPL-3.0-or-later
// Tasks rendered, each by the road of `physvib render`, and kept.
#pragma once
#include "CommandLine/Sweep/SweepFolder.h"
#include "CommandLine/Sweep/SweepPlan.h"
#include <string>

namespace physvib {

/// Every so many-th task from the `number`-th on, from 1: what one of several calls does.
struct SweepPart {
    std::uint64_t number = 1, parts = 1;
};

struct SweepTally {
    std::uint64_t rendered = 0, failed = 0;
    std::string fault; ///< of the first that failed: its call, and why
};

/// Renders what `folder` does not have yet, one task after the other, and waits for what other programs are
/// rendering in it. M only.
SweepTally runSweepTasks(const SweepPlan& plan, const SweepFolder& folder, const SweepPart& part);

} // namespace physvib
