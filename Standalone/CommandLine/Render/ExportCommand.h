// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib export`: a scene, a saved session, an event list or a clip as a haptic file of others.
#pragma once
#include "CommandLine/Render/RenderOptions.h"
#include <string>

namespace physvib {

struct ExportOptions {
    RenderOptions input; ///< what is exported, and how it is spread
    std::string to;      ///< path; its ending says the format
    double error = 0.004;
};

/// Declares all options of `export`.
void declareExport(OptionTable& command, ExportOptions& options);

/// All files appear, or none; a line per file, and one per thing that the format cannot carry. An exit code.
int runExport(const OptionTable& command, ExportOptions& options);

} // namespace physvib
