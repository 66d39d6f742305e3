// SPDX-License-Identifier: MIT
// A stimulus as samples, one channel per enchanter, by the renderer that plays everything else.
#pragma once
#include "Io/Result.h"
#include "Io/Wav/SampledSound.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"

namespace physvib {

constexpr double fullScaleSlack = 1e-6; ///< beyond full scale: a sine's peak at a rounded level

/// 1 is an enchanter's full scale.
using StimulusSound = SampledSound;

/// The stimulus in units of each enchanter's full scale. No limiter: a stimulus is played as it is, or
/// refused where a channel would leave its full scale. `layout` has as many enchanters as the stimulus. M
/// only.
Result<StimulusSound> renderStimulus(const Stimulus& stimulus, const LayoutDescription& layout,
                                     int sampleRateHz);

/// A recording of one channel as a phantom at `place`: its peak becomes `levelG`, spread by `panner`. Within
/// full scale as above. M only.
Result<StimulusSound> placeRecording(const StimulusSound& recording, const FieldPlace& place, double levelG,
                                     const PhantomPanner& panner, const LayoutDescription& layout);

} // namespace physvib
