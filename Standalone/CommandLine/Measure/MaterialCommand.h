// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib material`: frequency and decay of a recorded contact, grains of a recorded scrape.
#pragma once
#include <optional>
#include <string>

namespace physvib {

class OptionTable;

/// As given on the command line.
struct MaterialOptions {
    std::string path;
    std::string band = "20-1000"; ///< "LO-HI" in Hz
    std::string rule = "fit";     ///< or "two-peaks"
    bool lists = false;           ///< the built-in library, instead
    std::string texturePath;      ///< a scrape, or a toolkit's models of some, instead
    std::optional<double> speedMetresPerSecond;
    double loadNewtons = 1.0, massKg = 1.0;
};

void declareMaterial(OptionTable& command, MaterialOptions& options);

/// Of a recording two lines of CSV on stdout, one line (of a model two) on how sure they are on stderr; the code to leave with.
int runMaterial(const MaterialOptions& options);

} // namespace physvib
