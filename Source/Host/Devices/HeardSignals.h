// SPDX-License-Identifier: GPL-3.0-or-later
// What plays on outputs that are no enchanter's: noise and contact sounds for ears, marks for machines.
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

/// As loud as its settings say, not as the master level does.
class HeardSignals {
public:
    /// `map` says which outputs; it outlives this object.
    explicit HeardSignals(const OutputMap& map)
        : map_{map} {}

    /// M.
    void setLevels(const ListeningSettings& listening);
    /// M, while R does not run.
    void prepare(int sampleRateHz, int blockFrames);

    /// The next block of `frames`: in silence if it `rests`. R, wait-free, as what follows.
    void begin(bool rests, int frames) noexcept;
    /// `frames` of it to `out`, from `first` on. `signals`: those of `session`, ears and marks behind its
    /// channels; ears are changed.
    void render(const Session& session, float* const* signals, float* const* out, int outputs, int first,
                int frames) noexcept;

private:
    void renderMarks(float* marks, float* const* out, int outputs, int first, int frames) noexcept;
    void addTo(Heard source, float* const* signals, int count, float* const* out, int outputs, int first,
               int frames) noexcept;

    const OutputMap& map_;
    std::atomic<float> noiseGain_{0.0f}, contactGain_{0.0f};

    // R, set while it does not run
    GainRamp noiseRamp_, contactRamp_;
    PinkNoise noise_;
    std::vector<float> noiseScratch_;
    bool rests_ = false, areMarksOpen_ = true; // the next pulse is whole
};

} // namespace physvib
