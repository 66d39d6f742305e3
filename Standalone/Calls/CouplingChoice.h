// SPDX-License-Identifier: GPL-3.0-or-later
// What --coupling means for a layout.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/Coupling.h"
#include "Scene/LayoutFile.h"
#include <string>

namespace physvib {

/// Drives that make up for a measured coupling.
struct CouplingChoice {
    CouplingDrives drives; ///< none: nothing is made up for
    std::string note;      ///< a line for people: what is left, and what it costs
};

/// Of the file at `path`; one line if it is not the coupling of as many enchanters as `layout` has. M only.
Result<CouplingChoice> chooseCoupling(const std::string& path, const LayoutDescription& layout);

} // namespace physvib
