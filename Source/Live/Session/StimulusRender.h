// SPDX-License-Identifier: MIT
// Renders a stimulus of a study to samples, one channel per actuator, with the common renderer.
#pragma once
#include "Core/HapticRenderer.h"
#include "Io/Result.h"
#include "Io/Wav/SampledSound.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"

namespace physvib {

constexpr double fullScaleSlack = 1e-6; ///< tolerance above full scale: rounding of a sine's peak

/// 1 is an actuator's full scale.
using StimulusSound = SampledSound;

/// A renderer without limiter for the stimulus alone, with memory for as many modes as it has events: a study
/// has hundreds of stimuli. Any thread.
RendererSettings rendererFor(const Stimulus& stimulus, int sampleRateHz);

/// The stimulus in units of each actuator's full scale. Without a limiter: a stimulus that would exceed full
/// scale is refused, so that it is never changed. `layout` has as many actuators as the stimulus. M.
Result<StimulusSound> renderStimulus(const Stimulus& stimulus, const LayoutDescription& layout,
                                     int sampleRateHz);

/// A one-channel recording as a phantom at `place`: scaled to a peak of `levelG` and distributed by `panner`.
/// Refused above full scale, as above. M only.
Result<StimulusSound> placeRecording(const StimulusSound& recording, const FieldPlace& place, double levelG,
                                     const PhantomPanner& panner, const LayoutDescription& layout);

} // namespace physvib
