// SPDX-License-Identifier: MIT
// Signals on outputs that drive no actuator: masking noise and contact sounds for headphones, onset marks for
// measuring devices.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Units.h"
#include "Live/Devices/AudioOutputSettings.h"
#include "Live/Devices/OutputMap.h"
#include "Live/Session/Session.h"
#include "Stimuli/PinkNoise.h"
#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>
#include <vector>

namespace physvib {

// Limits samples to a range.

/// Limits to -most..most; NaN becomes -most, which OutputGuard then takes away. R, wait-free.
inline void clip(float* samples, float most, int frames) noexcept {
    std::transform(samples, samples + frames, samples,
                   [most](float x) { return std::min(most, std::max(-most, x)); });
}

/// Levels come from ListeningSettings; the master level does not apply.
class MonitorMix {
public:
    /// `map` assigns the outputs; it outlives this object.
    explicit MonitorMix(const OutputMap& map)
        : map_{map} {}

    /// M.
    // The noise generator has a level of its own, so the gain is relative to it.
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

    /// Starts a block of `frames`; `rests`: it is silent. R, wait-free, as render().
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
    /// Writes `frames` of the block to `out`, from `first` on. `signals` are the outputs of `session`:
    /// contact sounds and marks follow its channels. The contact sounds are scaled in place.
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
    static constexpr double noiseFadeSeconds = 2.0; // ramp to full scale, slow enough not to startle

    // Output that is silenced gets no marks. If the silence ends within a pulse, the rest of that pulse is
    // skipped, because its edge was silenced.
    void renderMarks(float* marks, float* const* out, int outputs, int first, int frames) noexcept {
        int begin = rests_ ? frames : 0;
        while (begin < frames && !areMarksOpen_)
            areMarksOpen_ = marks[begin] == 0.0f, begin += areMarksOpen_ ? 0 : 1;
        marks += begin;
        addTo(Heard::marks, &marks, 1, out, outputs, first + begin, frames - begin);
    }
    // Two signals alternate over the outputs: left, right, left... Nothing else plays on these outputs, and
    // the sum of noise and contact sounds is clipped to full scale.
    void addTo(Heard source, float* const* signals, int count, float* const* out, int outputs, int first,
               int frames) noexcept {
        for (int i = 0; i < OutputMap::mostHeard; ++i) {
            const int k = map_.heardAt(source, i);
            if (k < 0 || k >= outputs) continue;
            float* const at = out[k] + first;
            std::transform(at, at + frames, signals[i % count], at, std::plus{});
            clip(at, 1.0f, frames);
        }
    }

    const OutputMap& map_;
    std::atomic<float> noiseGain_{0.0f}, contactGain_{0.0f};

    // R; set while R does not run
    GainRamp noiseRamp_, contactRamp_;
    PinkNoise noise_;
    std::vector<float> noiseScratch_;
    bool rests_ = false, areMarksOpen_ = true; // the next pulse is complete
};

} // namespace physvib
