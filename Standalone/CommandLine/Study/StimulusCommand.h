// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib stimulus`: renders single stimuli of the studies to files.
#pragma once
#include "Calls/StimulusOptions.h"

namespace physvib {

/// Runs the parsed `command`. Returns an exit code.
int runStimulus(const OptionTable& command, const StimulusOptions& options);

} // namespace physvib
