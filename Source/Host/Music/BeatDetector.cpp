// SPDX-License-Identifier: GPL-3.0-or-later
// For each hop: spectrum, spectral flux in each band, and a peak picker on the flux.
#include "Host/Music/BeatDetector.h"
#include <bit>
#include <cmath>

namespace physvib {

namespace {

constexpr double maxWindowSeconds = 0.0335; // rounded down to a power of two samples, 17 to 33 ms: two
                                            // periods of a bass drum, but short against a beat
constexpr unsigned hopsPerWindow = 8;
constexpr int pickerDelayHops = 2; // aubio's picker needs the hop after the peak, and smooths over one more
constexpr double earlyHops = 0.35; // the flux peaks this long before the onset reaches the middle of the
                                   // window (measured: Docs/music.md)
constexpr double minOnsetGapSeconds = 0.05; // per band: at most twenty onsets a second
// Time constants (decay to 37 %) of the mean flux, the maximum and the masking after an onset.
constexpr double meanFluxSeconds = 1.0, maxFluxSeconds = 5.0, maskingSeconds = 0.1;
constexpr double minRise = 3.0;          // relative to the mean flux
constexpr double minFlux = 1e-3;         // about that of a starting sine at -60 dB
constexpr double minShareAtOne = 0.0625; // of the strongest onset; to the power of the sensitivity

unsigned windowSamples(int rateHz) noexcept {
    return std::max(16u, std::bit_floor(static_cast<unsigned>(maxWindowSeconds * rateHz)));
}

} // namespace

BeatDetector::BeatDetector(int sampleRateHz, double sensitivity)
    : rateHz_{sampleRateHz}
    , hop_{new_fvec(windowSamples(sampleRateHz) / hopsPerWindow)}
    , flux_{new_fvec(1)}
    , peak_{new_fvec(1)}
    , spectrum_{new_cvec(windowSamples(sampleRateHz))}
    , vocoder_{new_aubio_pvoc(windowSamples(sampleRateHz), hop_->length)} {
    setSensitivity(sensitivity);
    for (std::size_t i = 0; i < bands_.size(); ++i) makeBand(i);
}

void BeatDetector::setSensitivity(double sensitivity) noexcept {
    minShare_ = std::pow(minShareAtOne, std::clamp(sensitivity, 0.0, 1.0));
}

void BeatDetector::makeBand(std::size_t index) {
    const double hzPerBin = static_cast<double>(rateHz_) / windowSamples(rateHz_);
    const uint_t end = spectrum_->length - 1; // half the sample rate
    const auto toBin = [=](double hz) {
        return std::min(end, static_cast<uint_t>(std::lround(hz / hzPerBin)));
    };
    const uint_t first = std::max(1u, toBin(beatBands[index].lowHz)),
                 endBin = std::max(first + 1, toBin(beatBands[index].highHz) + 1);
    if (first >= end) return;
    Band& band = bands_[index];
    band.spectrum = {std::min(end, endBin) - first, spectrum_->norm + first, spectrum_->phas + first};
    band.flux.reset(new_aubio_specdesc("specflux", 2 * band.spectrum.length));
    band.peaks.reset(new_aubio_peakpicker());
}

void BeatDetector::analyse() noexcept {
    ++hops_;
    onsetCount_ = 0;
    aubio_pvoc_do(vocoder_.get(), hop_.get(), spectrum_.get());
    for (std::size_t i = 0; i < bands_.size(); ++i)
        if (bands_[i].flux) detectOnset(i);
}

void BeatDetector::measureFlux(Band& band) noexcept {
    aubio_specdesc_do(band.flux.get(), &band.spectrum, flux_.get());
    std::rotate(band.recentFlux.begin(), band.recentFlux.begin() + 1, band.recentFlux.end());
    band.recentFlux.back() = flux_->data[0];
    aubio_peakpicker_do(band.peaks.get(), flux_.get(), peak_.get());
}

void BeatDetector::updateAverages(Band& band) noexcept {
    const double hopSeconds = static_cast<double>(hop_->length) / rateHz_;
    const auto decay = [=](double seconds) { return std::exp(-hopSeconds / seconds); };
    band.maxFlux *= decay(maxFluxSeconds);
    band.maskingThreshold *= decay(maskingSeconds);
    // at first the plain mean of all hops
    band.meanFlux += std::max(1.0 - decay(meanFluxSeconds), 1.0 / static_cast<double>(hops_)) *
                     (band.recentFlux.back() - band.meanFlux);
}

bool BeatDetector::isOnset(const Band& band, double height, std::int64_t frame) const noexcept {
    const bool isSoon =
        band.hasOnset && static_cast<double>(frame - band.lastOnsetFrame) < minOnsetGapSeconds * rateHz_;
    return frame >= 0 && !isSoon &&
           height >=
               std::max({minFlux, minRise * band.meanFlux, minShare_ * band.maxFlux, band.maskingThreshold});
}

void BeatDetector::detectOnset(std::size_t index) noexcept {
    Band& band = bands_[index];
    measureFlux(band);
    const double peakHops = peak_->data[0]; // 0, or the position of the peak in hops, about 1
    if (peakHops != 0.0) {
        const double height = std::ranges::max(band.recentFlux);
        band.maxFlux = std::max(band.maxFlux, height);
        const double hop = static_cast<double>(hops_ - pickerDelayHops) + peakHops - 1.0 + earlyHops;
        const auto frame =
            static_cast<std::int64_t>(std::llround((hop - 0.5 * hopsPerWindow) * hop_->length));
        if (isOnset(band, height, frame)) {
            onsets_[onsetCount_++] = {frame, static_cast<int>(index), height / band.maxFlux};
            band.lastOnsetFrame = frame;
            band.hasOnset = true;
            band.maskingThreshold = height;
        }
    }
    updateAverages(band);
}

std::int64_t BeatDetector::delayFrames() const noexcept {
    return static_cast<std::int64_t>(hopsPerWindow / 2 + pickerDelayHops + 1) * hop_->length;
}

// aubio's objects remember one window and the few hops of the peak picker. This many zero hops return them to
// their initial state.
void BeatDetector::reset() noexcept {
    constexpr unsigned rememberedHops = hopsPerWindow + 12;
    fvec_zeros(hop_.get());
    for (unsigned i = 0; i < rememberedHops; ++i) {
        aubio_pvoc_do(vocoder_.get(), hop_.get(), spectrum_.get());
        for (Band& band : bands_)
            if (band.flux) measureFlux(band);
    }
    for (Band& band : bands_) {
        band.meanFlux = band.maxFlux = band.maskingThreshold = 0.0;
        band.hasOnset = false;
    }
    hopFill_ = 0;
    hops_ = 0;
}

std::array<ActuatorSet, beatBands.size()> defaultBeatActuators(int count) noexcept {
    const auto last = static_cast<std::size_t>(count - 1);
    std::array<ActuatorSet, beatBands.size()> sets{};
    sets.front()[0] = sets.back()[last] = true;
    for (std::size_t j = std::min<std::size_t>(1, last); j < std::max<std::size_t>(last, 1); ++j)
        sets[1][j] = true;
    if (count == 2) sets[1] = sets.back();
    return sets;
}

bool parseActuatorLetters(std::string_view letters, int count, ActuatorSet& actuators) {
    actuators.reset();
    for (const char letter : letters) {
        const int j = letter - 'A';
        if (j < 0 || j >= count || actuators[static_cast<std::size_t>(j)]) return false;
        actuators[static_cast<std::size_t>(j)] = true;
    }
    return true;
}

} // namespace physvib
