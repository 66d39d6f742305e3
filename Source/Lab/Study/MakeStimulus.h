// SPDX-License-Identifier: MIT
// What a StimulusJob becomes on a layout.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/StimulusJob.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"

namespace physvib {

/// Empty, or which enchanter of the job the layout lacks, in one line. Any thread (allocates).
std::string layoutFault(const StimulusJob& job, const LayoutDescription& layout);

/// The events of a job without a fault, and without a recording, whose layout this is; or one line. M only.
Result<Stimulus> makeStimulus(const StimulusJob& job, const LayoutDescription& layout);

} // namespace physvib
