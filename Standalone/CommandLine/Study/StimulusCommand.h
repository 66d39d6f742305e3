// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib stimulus`: single stimuli of the studies, as files.
#pragma once
#include "Calls/StimulusOptions.h"

namespace physvib {

/// Makes what `command` has parsed; the code to leave with.
int runStimulus(const OptionTable& command, const StimulusOptions& options);

} // namespace physvib
