// SPDX-License-Identifier: GPL-3.0-or-later
// Levels and ramps of noise, contact sounds and marks, and their distribution over the listening outputs.
#include "Host/Devices/HeardSignals.h"
#include "Core/Decibels.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace physvib {

namespace {

constexpr double fadeInSeconds = 0.005;
constexpr double noiseFadeSeconds = 2.0; // ramp to full scale, slow enough not to startle

} // namespace

// The noise generator has a level of its own, so the gain is relative to it.
void HeardSignals::setLevels(const ListeningSettings& l) {
    const auto gainOf = [](double db, double leastDb, double mostDb) {
        return fromDecibels(std::clamp(db, leastDb, mostDb));
    };
    noiseGain_ = l.noise.empty()
                     ? 0.0f
                     : static_cast<float>(gainOf(l.noiseDb, PinkNoise::leastDb, PinkNoise::mostDb) /
                                          PinkNoise::rootMeanSquare);
    contactGain_ =
        l.contacts.empty() ? 0.0f : static_cast<float>(gainOf(l.contactDb, leastContactDb, mostContactDb));
}

void HeardSignals::prepare(int sampleRateHz, int blockFrames) {
    noiseScratch_.assign(static_cast<std::size_t>(blockFrames), 0.0f);
    noiseRamp_.prepare(sampleRateHz, noiseFadeSeconds, 0.0f);
    contactRamp_.prepare(sampleRateHz, fadeInSeconds, 0.0f);
}

void HeardSignals::begin(bool rests, int frames) noexcept {
    rests_ = rests;
    for (auto [ramp, gain] : {std::pair{&noiseRamp_, &noiseGain_}, {&contactRamp_, &contactGain_}}) {
        if (rests)
            ramp->moveTo(0.0f, frames);
        else
            ramp->moveTo(gain->load(std::memory_order_relaxed));
    }
    if (rests) areMarksOpen_ = false;
}

void HeardSignals::render(const Session& session, float* const* signals, float* const* out, int outputs,
                          int first, int frames) noexcept {
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

// Output that is silenced gets no marks. If the silence ends within a pulse, the rest of that pulse is
// skipped, because its edge was silenced.
void HeardSignals::renderMarks(float* marks, float* const* out, int outputs, int first, int frames) noexcept {
    int begin = rests_ ? frames : 0;
    while (begin < frames && !areMarksOpen_)
        areMarksOpen_ = marks[begin] == 0.0f, begin += areMarksOpen_ ? 0 : 1;
    marks += begin;
    addTo(Heard::marks, &marks, 1, out, outputs, first + begin, frames - begin);
}

// Two signals alternate over the outputs: left, right, left... Nothing else plays on these outputs, and the
// sum of noise and contact sounds is clipped to full scale.
void HeardSignals::addTo(Heard source, float* const* signals, int count, float* const* out, int outputs,
                         int first, int frames) noexcept {
    for (int i = 0; i < OutputMap::mostHeard; ++i) {
        const int k = map_.heardAt(source, i);
        if (k < 0 || k >= outputs) continue;
        juce::FloatVectorOperations::add(out[k] + first, signals[i % count], frames);
        juce::FloatVectorOperations::clip(out[k] + first, out[k] + first, -1.0f, 1.0f, frames);
    }
}

} // namespace physvib
