// SPDX-License-Identifier: GPL-3.0-or-later
// Real-time onset detection in music, per frequency band, with aubio: phase vocoder, spectral flux, peak
// picker.
#pragma once
#define AUBIO_UNSTABLE 1 // aubio declares its peak picker only with this; its version is the distribution's
#include "Host/Music/BeatStrikes.h"
#include <array>
#include <aubio/aubio.h>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace physvib {

/// Owning pointer for objects of the aubio library, which must be freed by aubio's own functions.
template <auto Free>
struct GivenBack {
    template <class T>
    void operator()(T* part) const {
        Free(part);
    }
};
template <class T, auto Free>
using AubioPart = std::unique_ptr<T, GivenBack<Free>>;

/// The result does not depend on how the input is divided into blocks. Created and destroyed on any thread
/// but R; all else on any thread, one at a time. R may call it: it neither allocates nor waits.
class BeatDetector {
public:
    static constexpr double usualSensitivity = 0.5;
    static constexpr double mostDelaySeconds = 0.0295; ///< upper bound of delayFrames() at any sample rate

    explicit BeatDetector(int sampleRateHz, double sensitivity = usualSensitivity);

    /// From 0 (the strongest onsets only) to 1 (every onset).
    void setSensitivity(double sensitivity) noexcept;

    /// Returns to the initial state: the next sample is number 0.
    void reset() noexcept;

    /// Processes the next samples. Calls `use(const BandOnset&)` for each onset detected.
    template <class Use>
    void take(std::span<const float> samples, Use&& use) noexcept(noexcept(use(BandOnset{}))) {
        for (const float sample : samples) {
            hop_->data[filled_] = sample;
            if (++filled_ < hop_->length) continue;
            filled_ = 0;
            analyse();
            for (std::size_t i = 0; i < foundCount_; ++i) use(found_[i]);
        }
    }

    /// Maximum delay from an onset's frame to its report, in samples.
    std::int64_t delayFrames() const noexcept;

private:
    struct Band {
        cvec_t part{}; // bins of the spectrum; empty if the sample rate has none of the band
        AubioPart<aubio_specdesc_t, del_aubio_specdesc> flux;
        AubioPart<aubio_peakpicker_t, del_aubio_peakpicker> peaks;
        std::array<double, 4> latest{};      // flux of the last hops, among them the peak
        double usual = 0.0, strongest = 0.0; // running mean and maximum of the flux
        double masked = 0.0;                 // threshold after the last onset, decaying
        std::int64_t lastFrame = 0;
        bool hasLast = false;
    };
    void makeBand(std::size_t index);
    void measure(Band& band) noexcept;
    void follow(Band& band) noexcept;
    bool isOnset(const Band& band, double height, std::int64_t frame) const noexcept;
    void look(std::size_t index) noexcept;
    void analyse() noexcept;

    const int rateHz_;
    double minShare_ = 0.0; // relative to the strongest
    AubioPart<fvec_t, del_fvec> hop_, flux_, peak_;
    AubioPart<cvec_t, del_cvec> spectrum_;
    AubioPart<aubio_pvoc_t, del_aubio_pvoc> vocoder_;
    std::array<Band, beatBands.size()> bands_;
    std::array<BandOnset, beatBands.size()> found_{};
    std::size_t foundCount_ = 0;
    unsigned filled_ = 0; // samples in the current hop
    std::int64_t hops_ = 0;
};

} // namespace physvib
