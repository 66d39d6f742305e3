// SPDX-License-Identifier: GPL-3.0-or-later
// BeatDetector finds onsets in music per frequency band, in real time with aubio; makeBeatEvents makes events
// of them; BandPass keeps the band that actuators can render.
#pragma once
#define AUBIO_UNSTABLE 1 // aubio declares its peak picker only with this; its version is the distribution's
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Core/Limits.h"
#include <algorithm>
#include <array>
#include <aubio/aubio.h>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace physvib {

struct BeatBand {
    std::string_view name;
    double lowHz = 0.0, highHz = 0.0;
};

/// Bass drum and bass; melody and body of the snare; cymbals and hi-hats. The gaps between are left out,
/// because every instrument has energy there.
inline constexpr std::array<BeatBand, 3> beatBands{
    {{"low", 30.0, 150.0}, {"mid", 200.0, 2500.0}, {"high", 6000.0, 16000.0}}};

/// An onset in one band.
struct BandOnset {
    std::int64_t frame = 0; ///< of the input, from 0
    int band = 0;           ///< index into beatBands
    double strength = 0.0;  ///< of the strongest onset of that band in the last seconds; above 0, up to 1
    bool operator==(const BandOnset&) const = default;
};

using ActuatorSet = std::bitset<limits::maxActuators>;

/// Vibration of the beats, per band.
struct BeatVoices {
    static constexpr double defaultLevel = 0.5;

    std::array<ActuatorSet, beatBands.size()> actuators; ///< of each band; none: the band is not felt
    /// resonance of the thesis' actuator
    std::array<double, beatBands.size()> frequencyHz{205.0, 205.0, 205.0};
    std::array<double, beatBands.size()> decayPerSecond{15.0, 30.0, 60.0}; ///< long, short, tick
    double level = defaultLevel; ///< peak of the strongest onset at gain 1, 1 = full scale
};

/// Low band on the first actuator, high on the last, mid on those between (with two: on the last). Any
/// thread, R too.
std::array<ActuatorSet, beatBands.size()> defaultBeatActuators(int count) noexcept;

/// Parses letters such as "AC"; false if one is not among `count` actuators or occurs twice. Any thread.
bool parseActuatorLetters(std::string_view letters, int count, ActuatorSet& actuators);

/// Calls `onEvent(const CollisionEvent&)` for each actuator of the onset's band, at `timeNs` and at the
/// actuator's place in a field of that size. Any thread, R too.
template <class EventSink>
void makeBeatEvents(const BandOnset& onset, std::int64_t timeNs, const BeatVoices& voices,
                    const ActuatorLayout& layout, double fieldWidthMetres, double fieldHeightMetres,
                    EventSink&& onEvent) {
    const auto band = static_cast<std::size_t>(onset.band);
    for (int j = 0; j < layout.count; ++j) {
        if (!voices.actuators[band][static_cast<std::size_t>(j)]) continue;
        const ActuatorPlace& place = layout.places[static_cast<std::size_t>(j)];
        CollisionEvent event;
        event.timeNs = timeNs;
        event.frequencyHz = voices.frequencyHz[band];
        event.decayPerSecond = voices.decayPerSecond[band];
        event.amplitude = voices.level * onset.strength;
        event.x = place.xMetres / layout.extentWidthMetres * fieldWidthMetres;
        event.y = place.yMetres / layout.extentHeightMetres * fieldHeightMetres;
        onEvent(event);
    }
}

/// Owning pointer for objects of the aubio library, which must be freed by aubio's own functions.
template <auto Free>
struct AubioDeleter {
    template <class T>
    void operator()(T* part) const {
        Free(part);
    }
};
template <class T, auto Free>
using AubioPointer = std::unique_ptr<T, AubioDeleter<Free>>;

/// The result does not depend on how the input is divided into blocks. Created and destroyed on any thread
/// but R; all else on any thread, one at a time. R may call it: it neither allocates nor waits.
class BeatDetector {
public:
    static constexpr double defaultSensitivity = 0.5;
    static constexpr double maxDelaySeconds = 0.0295; ///< upper bound of delayFrames() at any sample rate

    explicit BeatDetector(int sampleRateHz, double sensitivity = defaultSensitivity);

    /// From 0 (the strongest onsets only) to 1 (every onset).
    void setSensitivity(double sensitivity) noexcept;

    /// Returns to the initial state: the next sample is number 0.
    void reset() noexcept;

    /// Processes the next samples. Calls `onOnset(const BandOnset&)` for each onset detected.
    template <class OnOnset>
    void process(std::span<const float> samples, OnOnset&& onOnset) noexcept(noexcept(onOnset(BandOnset{}))) {
        for (const float sample : samples) {
            hop_->data[hopFill_] = sample;
            if (++hopFill_ < hop_->length) continue;
            hopFill_ = 0;
            analyse();
            for (std::size_t i = 0; i < onsetCount_; ++i) onOnset(onsets_[i]);
        }
    }

    /// Maximum delay from an onset's frame to its report, in samples.
    std::int64_t delayFrames() const noexcept;

private:
    struct Band {
        cvec_t spectrum{}; // bins of the spectrum; empty if the sample rate has none of the band
        AubioPointer<aubio_specdesc_t, del_aubio_specdesc> flux;
        AubioPointer<aubio_peakpicker_t, del_aubio_peakpicker> peaks;
        std::array<double, 4> recentFlux{};   // flux of the last hops, among them the peak
        double meanFlux = 0.0, maxFlux = 0.0; // running mean and maximum of the flux
        double maskingThreshold = 0.0;        // threshold after the last onset, decaying
        std::int64_t lastOnsetFrame = 0;
        bool hasOnset = false;
    };
    void makeBand(std::size_t index);
    void measureFlux(Band& band) noexcept;
    void updateAverages(Band& band) noexcept;
    bool isOnset(const Band& band, double height, std::int64_t frame) const noexcept;
    void detectOnset(std::size_t index) noexcept;
    void analyse() noexcept;

    const int rateHz_;
    double minShare_ = 0.0; // relative to the strongest
    AubioPointer<fvec_t, del_fvec> hop_, flux_, peak_;
    AubioPointer<cvec_t, del_cvec> spectrum_;
    AubioPointer<aubio_pvoc_t, del_aubio_pvoc> vocoder_;
    std::array<Band, beatBands.size()> bands_;
    std::array<BandOnset, beatBands.size()> onsets_{};
    std::size_t onsetCount_ = 0;
    unsigned hopFill_ = 0; // samples in the current hop
    std::int64_t hops_ = 0;
};

// Band-pass filter that keeps the band an actuator can render: two Butterworth slopes of fourth order.

/// Causal; its group delay at 200 Hz is 2 ms with the default band. One thread at a time.
class BandPass {
public:
    static constexpr FrequencyBand defaultBand{50.0, 500.0};

    /// The upper cut-off is at most 45 % of the sample rate.
    BandPass(FrequencyBand band, int sampleRateHz) noexcept {
        const double highHz = std::min(band.highHz, 0.45 * sampleRateHz),
                     lowHz = std::min(band.lowHz, 0.5 * highHz);
        for (std::size_t i = 0; i < qs.size(); ++i) {
            // low-pass: zeros at half the sample rate; high-pass: zeros at 0 Hz
            sections_[2 * i] = section(highHz, qs[i], {2.0, 1.0}, 1.0, sampleRateHz);
            sections_[2 * i + 1] = section(lowHz, qs[i], {-2.0, 1.0}, -1.0, sampleRateHz);
        }
    }

    void process(std::span<float> samples) noexcept {
        for (float& sample : samples) {
            double y = sample;
            for (Biquad& section : sections_) y = section.process(y);
            sample = static_cast<float>(y);
        }
    }

private:
    static constexpr std::array qs{0.54119610014619698, 1.3065629648763766};

    /// A biquad with these zeros and a gain of 1 where z is `unity`.
    static Biquad section(double hz, double q, RootPair zeros, double unity, double rateHz) noexcept {
        const RootPair poles = RootPair::bilinear(hz, q, rateHz);
        return {(poles.at(unity) / zeros.at(unity)).real(), zeros, poles};
    }

    std::array<Biquad, 4> sections_;
};

} // namespace physvib
