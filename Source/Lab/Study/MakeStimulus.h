// SPDX-License-Identifier: MIT
// Creates a stimulus (events) from a StimulusJob and an actuator layout.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/StimulusJob.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"

namespace physvib {

/// Empty, or one line naming the actuator of the job that the layout lacks. Any thread (allocates).
std::string layoutFault(const StimulusJob& job, const LayoutDescription& layout);

/// Events of a valid job without a recording, on its layout; or an error in one line. Message thread only.
Result<Stimulus> makeStimulus(const StimulusJob& job, const LayoutDescription& layout);

} // namespace physvib
