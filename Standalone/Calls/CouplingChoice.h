// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates --coupling for a layout.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/Coupling.h"
#include "Scene/LayoutFile.h"
#include <string>

namespace physvib {

/// Drives that compensate a measured coupling.
struct CouplingChoice {
    CouplingDrives drives; ///< empty: no compensation
    std::string note;      ///< residual error and cost, in one line
};

/// Loads the coupling at `path`. One error line if it is not for the number of actuators in `layout`. Message
/// thread only.
Result<CouplingChoice> chooseCoupling(const std::string& path, const LayoutDescription& layout);

} // namespace physvib
