// SPDX-License-Identifier: MIT
// A clip as samples.
#pragma once
#include "Formats/Clip.h"
#include "Io/Wav/SampledSound.h"

namespace physvib {

/// Every channel of `clip` (without a clipFault) at that rate, from 0 s to its end; what lies at or above
/// half the rate is left out. 1 is full scale. Any thread.
SampledSound clipSound(const Clip& clip, int sampleRateHz);

} // namespace physvib
