// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib coupling`: what `render --coupling` reads, from recordings.
#pragma once
#include <string>

namespace physvib {

class OptionTable;

/// As given on the command line.
struct CouplingOptions {
    std::string folder, layout, outPath;
};

void declareCoupling(OptionTable& command, CouplingOptions& options);

/// Writes the file; the code to leave with.
int runCoupling(const CouplingOptions& options);

} // namespace physvib
