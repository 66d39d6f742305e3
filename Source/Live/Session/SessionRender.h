// SPDX-License-Identifier: MIT
// Renders a saved session offline, to the samples that were played, and stimuli of studies.
#pragma once
#include "Core/HapticRenderer.h"
#include "Core/RenderControl.h"
#include "Io/Result.h"
#include "Io/Wav/SampledSound.h"
#include "Live/Documents/SessionFile.h"
#include "Live/Documents/SessionLog.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/OfflineRender.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace physvib {

// The recordings and clips of a saved session, prepared for a renderer.

/// The recordings that a session plays. A study switches between the same few sets many times.
struct LoadedRecordings {
    std::vector<std::vector<ContactRecording>> sets; ///< without duplicates
    std::vector<std::size_t> setIndices;   ///< index into `sets` per change in SessionLog::recordings
    std::vector<ContactRecording> clips{}; ///< in the order of SessionLog::clips
};

/// Notes of all recordings and clips, without duplicates. Any thread.
std::vector<std::string> recordingNotes(const LoadedRecordings& loaded);

/// The recordings at one sample rate, and the controls that change between them. Must outlive the render.
/// Message thread (M) only.
class SessionRecordings {
public:
    SessionRecordings(const SessionLog& log, const LoadedRecordings& loaded, int sampleRateHz);

    /// Merges `controls`, in time order, with the changes of recordings.
    std::vector<RenderControl> mergedWith(std::vector<RenderControl> controls) const;

    /// These recordings plus the session's clips: what is in use from the start.
    RecordedContacts withClips(const std::vector<ContactRecording>& recordings) {
        return sets_.contacts(sampleRateHz_, recordings);
    }

private:
    int sampleRateHz_;
    RecordingSets sets_;
    std::vector<RenderControl> changes_;
};

/// All events of the session before `endNs`, of its worlds and its inputs, in time order and without shaping.
/// Message thread (M) only. Throws what Simulation throws.
SceneEvents sessionEvents(const SavedSession& session, std::int64_t endNs, const StepWatch& keepGoing = {});

/// How much of a session is rendered, and a callback for the progress from 0 to 1, the first half of which is
/// the simulation; the callback cancels by returning false.
struct SessionExtent {
    int sampleRateHz = 48000;
    double seconds = 0.0; ///< the last scene run continues for as long as this takes
    std::function<bool(double)> progress;
};

/// Passes the session's samples to `consume`; false if it or `progress` has cancelled. M only. Throws what
/// Simulation throws.
bool renderSession(const SavedSession& session, const LoadedRecordings& recordings,
                   const SessionExtent& extent, const BlockConsumer& consume);

// Renders a stimulus of a study to samples, one channel per actuator, with the common renderer.

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
