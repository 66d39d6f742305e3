// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib sweep`: all renders of a design, here or on a cluster, and one table of them.
#pragma once
#include <string>
#include <vector>

namespace physvib {

class OptionTable;

struct SweepOptions {
    std::string design, folder;
    int jobs = 0; ///< 0: as many as there are processors for this program
    bool keepsWavs = false, keepsEvents = false;
    bool plans = false, gathers = false, submits = false; ///< instead of rendering here
    std::string part;                                     ///< "K/N"
    std::vector<std::string> slurmWords;
};

/// Declares all options of `sweep`.
void declareSweep(OptionTable& command, SweepOptions& options);

/// What is done stays done, whatever ends the program. An exit code.
int runSweep(const SweepOptions& options);

} // namespace physvib
