// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib coupling`: what `render --coupling` reads, from recordings.
#pragma once
#include <string>

namespace CLI {
class App;
}

namespace physvib {

/// As given on the command line.
struct CouplingOptions {
    std::string folder, layout, outPath;
};

void declareCoupling(CLI::App& command, CouplingOptions& options);

/// Writes the file; the code to leave with.
int runCoupling(const CouplingOptions& options);

} // namespace physvib
