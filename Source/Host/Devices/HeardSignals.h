// SPDX-License-Identifier: GPL-3.0-or-later
// What plays on outputs that are no enchanter's: noise and contact sounds for ears, marks for machines.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Decibels.h"
#include "Host/Devices/AudioOutputSettings.h"
#include "Host/Devices/OutputMap.h"
#include "Live/Session/Session.h"
#include "Stimuli/PinkNoise.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <juce_audio_basics/juce_audio_basics.h>
#include <utility>
#include <vector>

namespace physvib {

/// As loud as its settings say, not as the master level does.
class HeardSignals {
public:
    /// `map` says which outputs; it outlives this object.
    explicit HeardSignals(const OutputMap& map)
        : map_{map} {}

    /// M.
    // The noise's generator has a level of its own.
    void setLevels(const ListeningSettings& l) {
        const auto gainOf = [](double db, double leastDb, double mostDb) {
            return fromDecibels(std::clamp(db, leastDb, mostDb));
        };
        noiseGain_ = l.noise.empty()
                         ? 0.0f
                         : static_cast<float>(gainOf(l.noiseDb, PinkNoise::leastDb, PinkNoise::mostDb) /
                                              PinkNoise::rootMeanSquare);
        contactGain_ = l.contacts.empty()
                           ? 0.0f
                           : static_cast<float>(gainOf(l.contactDb, leastContactDb, mostContactDb));
    }
    /// M, while R does not run.
    void prepare(int sampleRateHz, int blockFrames) {
        noiseScratch_.assign(static_cast<std::size_t>(blockFrames), 0.0f);
        noiseRamp_.prepare(sampleRateHz, noiseFadeSeconds, 0.0f);
        contactRamp_.prepare(sampleRateHz, fadeInSeconds, 0.0f);
    }

    /// The next block of `frames`: in silence if it `rests`. R, wait-free, as what follows.
    void begin(bool rests, int frames) noexcept {
        rests_ = rests;
        for (auto [ramp, gain] : {std::pair{&noiseRamp_, &noiseGain_}, {&contactRamp_, &contactGain_}}) {
            if (rests)
                ramp->moveTo(0.0f, frames);
            else
                ramp->moveTo(gain->load(std::memory_order_relaxed));
        }
        if (rests) areMarksOpen_ = false;
    }
    /// `frames` of it to `out`, from `first` on. `signals`: those of `session`, ears and marks behind its
    /// channels; ears are changed.
    void render(const Session& session, float* const* signals, float* const* out, int outputs, int first,
                int frames) noexcept {
        if (noiseGain_.load(std::memory_order_relaxed) > 0.0f) {
            float* noise = noiseScratch_.data();
            std::generate_n(noise, frames, [this] { return noise_.next(); });
            noiseRamp_.apply(&noise, 1, frames);
            addTo(Heard::noise, &noise, 1, out, outputs, first, frames);
        }
        if (session.rendered().heard() > 0) {
            float* const* const ears = signals + session.channels();
            contactRamp_.apply(ears, session.rendered().heard(), frames);
            addTo(Heard::contacts, ears, session.rendered().heard(), out, outputs, first, frames);
        }
        if (session.rendered().marks())
            renderMarks(signals[session.rendered().count() - 1], out, outputs, first, frames);
    }

private:
    static constexpr double fadeInSeconds = 0.005;
    static constexpr double noiseFadeSeconds = 2.0; // to full scale; nobody shall start

    // What is silenced is not felt, so it is not marked; what is left of a pulse when all comes back has its
    // edge in the silence.
    void renderMarks(float* marks, float* const* out, int outputs, int first, int frames) noexcept {
        int begin = rests_ ? frames : 0;
        while (begin < frames && !areMarksOpen_)
            areMarksOpen_ = marks[begin] == 0.0f, begin += areMarksOpen_ ? 0 : 1;
        marks += begin;
        addTo(Heard::marks, &marks, 1, out, outputs, first + begin, frames - begin);
    }
    // Of two signals the outputs take turns: left, right, left... Nothing else plays on them; together noise
    // and contacts stay within full scale.
    void addTo(Heard source, float* const* signals, int count, float* const* out, int outputs, int first,
               int frames) noexcept {
        for (int i = 0; i < OutputMap::mostHeard; ++i) {
            const int k = map_.heardAt(source, i);
            if (k < 0 || k >= outputs) continue;
            juce::FloatVectorOperations::add(out[k] + first, signals[i % count], frames);
            juce::FloatVectorOperations::clip(out[k] + first, out[k] + first, -1.0f, 1.0f, frames);
        }
    }

    const OutputMap& map_;
    std::atomic<float> noiseGain_{0.0f}, contactGain_{0.0f};

    // R, set while it does not run
    GainRamp noiseRamp_, contactRamp_;
    PinkNoise noise_;
    std::vector<float> noiseScratch_;
    bool rests_ = false, areMarksOpen_ = true; // the next pulse is whole
};

} // namespace physvib
