// SPDX-License-Identifier: GPL-3.0-or-later
// Onsets of music as it comes, by band: aubio's phase vocoder, its spectral flux of each band, its peak
// picker.
#pragma once
#include "Host/Music/AubioPart.h"
#include "Host/Music/BeatBands.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace physvib {

/// What is told does not depend on the pieces in which the sound comes. Made and freed on any thread but R;
/// all else on any thread, one at a time, R too: it takes no memory and waits for nothing.
class BeatDetector {
public:
    static constexpr double usualSensitivity = 0.5;
    static constexpr double mostDelaySeconds = 0.0295; ///< of delayFrames(), at any rate

    explicit BeatDetector(int sampleRateHz, double sensitivity = usualSensitivity);

    /// From 0 (only the strongest) to 1 (whatever stirs).
    void setSensitivity(double sensitivity) noexcept;

    /// As new: the next sample is number 0.
    void reset() noexcept;

    /// The next samples. Calls `tell(const BandOnset&)` of each onset that they complete.
    template <class Tell>
    void take(std::span<const float> samples, Tell&& tell) noexcept(noexcept(tell(BandOnset{}))) {
        for (const float sample : samples) {
            hop_->data[filled_] = sample;
            if (++filled_ < hop_->length) continue;
            filled_ = 0;
            analyse();
            for (std::size_t i = 0; i < foundCount_; ++i) tell(found_[i]);
        }
    }

    /// So many samples after its own an onset is told at the latest.
    std::int64_t delayFrames() const noexcept;

private:
    struct Band {
        cvec_t part{}; // of the spectrum; nothing, if the rate has none of the band
        AubioPart<aubio_specdesc_t, del_aubio_specdesc> flux;
        AubioPart<aubio_peakpicker_t, del_aubio_peakpicker> peaks;
        std::array<double, 4> latest{};      // flux of the last hops: the peak is among them
        double usual = 0.0, strongest = 0.0; // of the last seconds
        double masked = 0.0;                 // what rings after the last onset
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
    double leastShare_ = 0.0; // of the strongest
    AubioPart<fvec_t, del_fvec> hop_, flux_, peak_;
    AubioPart<cvec_t, del_cvec> spectrum_;
    AubioPart<aubio_pvoc_t, del_aubio_pvoc> vocoder_;
    std::array<Band, beatBands.size()> bands_;
    std::array<BandOnset, beatBands.size()> found_{};
    std::size_t foundCount_ = 0;
    unsigned filled_ = 0; // of the hop
    std::int64_t hops_ = 0;
};

} // namespace physvib
