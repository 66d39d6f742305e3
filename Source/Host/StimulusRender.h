// SPDX-License-Identifier: GPL-3.0-or-later
// A stimulus as samples, one channel per enchanter, by the renderer that plays everything else.
#pragma once
#include "Files/LayoutFile.h"
#include "Files/Result.h"
#include "Study/Stimulus.h"
#include <filesystem>
#include <vector>

namespace physvib {

/// Samples of every channel, all equally long; 1 is an enchanter's full scale.
struct StimulusSound {
    int sampleRateHz = 0;
    std::vector<std::vector<float>> channels;
};

/// The stimulus in units of each enchanter's full scale. No limiter: a stimulus is played as it is, or refused where a
/// channel would leave its full scale. `layout` has as many enchanters as the stimulus. M only.
Result<StimulusSound> renderStimulus(const Stimulus& stimulus, const LayoutDescription& layout, int sampleRateHz);

/// A recording (WAV, FLAC, Ogg Vorbis), as it is: its rate and channels. Any thread but R.
Result<StimulusSound> readRecording(const std::filesystem::path& path);

/// A recording of one channel as a phantom at `place`: its peak becomes `levelG`, spread by `panner`. As above. M only.
Result<StimulusSound> placeRecording(const StimulusSound& recording, const FieldPlace& place, double levelG, const PhantomPanner& panner, const LayoutDescription& layout);

} // namespace physvib
