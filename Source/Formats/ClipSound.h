// SPDX-License-Identifier: MIT
// Renders a clip to samples.
#pragma once
#include "Formats/Clip.h"
#include "Io/Wav/SampledSound.h"

namespace physvib {

/// Every channel of `clip` (which has no clipFault) at that sample rate, from 0 s to its end. Waves at or
/// above half the rate are omitted. 1 is full scale. Any thread.
SampledSound clipSound(const Clip& clip, int sampleRateHz);

} // namespace physvib
