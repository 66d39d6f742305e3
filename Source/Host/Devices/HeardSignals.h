// SPDX-License-Identifier: GPL-3.0-or-later
// Signals on outputs that drive no actuator: masking noise and contact sounds for headphones, onset marks for
// measuring devices.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Host/Devices/AudioOutputSettings.h"
#include "Host/Devices/OutputMap.h"
#include "Live/Session/Session.h"
#include "Stimuli/PinkNoise.h"
#include <atomic>
#include <juce_audio_basics/juce_audio_basics.h>
#include <vector>

namespace physvib {

/// Levels come from ListeningSettings; the master level does not apply.
class HeardSignals {
public:
    /// `map` assigns the outputs; it outlives this object.
    explicit HeardSignals(const OutputMap& map)
        : map_{map} {}

    /// M.
    void setLevels(const ListeningSettings& listening);
    /// M, while R does not run.
    void prepare(int sampleRateHz, int blockFrames);

    /// Starts a block of `frames`; `rests`: it is silent. R, wait-free, as render().
    void begin(bool rests, int frames) noexcept;
    /// Writes `frames` of the block to `out`, from `first` on. `signals` are the outputs of `session`:
    /// contact sounds and marks follow its channels. The contact sounds are scaled in place.
    void render(const Session& session, float* const* signals, float* const* out, int outputs, int first,
                int frames) noexcept;

private:
    void renderMarks(float* marks, float* const* out, int outputs, int first, int frames) noexcept;
    void addTo(Heard source, float* const* signals, int count, float* const* out, int outputs, int first,
               int frames) noexcept;

    const OutputMap& map_;
    std::atomic<float> noiseGain_{0.0f}, contactGain_{0.0f};

    // R; set while R does not run
    GainRamp noiseRamp_, contactRamp_;
    PinkNoise noise_;
    std::vector<float> noiseScratch_;
    bool rests_ = false, areMarksOpen_ = true; // the next pulse is complete
};

} // namespace physvib
