// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib material`: frequency and decay of a recorded contact.
#pragma once
#include <string>

namespace CLI {
class App;
}

namespace physvib {

/// As given on the command line.
struct MaterialOptions {
    std::string path;
    std::string band = "20-1000"; ///< "LO-HI" in Hz
    std::string rule = "fit";     ///< or "two-peaks"
    bool lists = false;           ///< the built-in library, instead
};

void declareMaterial(CLI::App& command, MaterialOptions& options);

/// Of a recording two lines of CSV on stdout, one line on how sure they are on stderr; the code to leave with.
int runMaterial(const MaterialOptions& options);

} // namespace physvib
