// SPDX-License-Identifier: MIT
// Extraction of a material: checks the recording, finds the impact, applies one of the two rules.
#include "Measure/MaterialExtractor.h"
#include "Io/Text/NumberText.h"
#include "Measure/HitExcerpt.h"
#include "Measure/HitFit.h"
#include "Measure/Spectrum.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <string>

namespace physvib {
namespace {

constexpr double minSeconds = 0.01; // half a period of the lowest perceptible frequency

std::string inputError(const std::vector<float>& x, double rateHz, ExtractionBand band) {
    if (!(rateHz > 0.0) || !(band.lowHz > 0.0) || !(band.highHz > band.lowHz))
        return "expected a band of two rising frequencies";
    if (band.highHz > 0.5 * rateHz)
        return "expected a band below half the rate of " + fixedNumber(rateHz, 0) + " Hz, found " +
               numberText(band.highHz) + " Hz";
    if (auto error = recordingError(x, rateHz, minSeconds); !error.empty()) return error;
    if (isSilent(x)) return "expected a hit, found silence";
    return clippingError(x, rateHz);
}

std::string noSoundError(ExtractionBand band) {
    return "expected a decaying sound from " + numberText(band.lowHz) + " to " + numberText(band.highHz) +
           " Hz, found none";
}

std::vector<double> copyExcerpt(const std::vector<float>& samples, std::size_t begin, std::size_t end,
                                double offset) {
    std::vector<double> all(samples.begin() + static_cast<std::ptrdiff_t>(begin),
                            samples.begin() + static_cast<std::ptrdiff_t>(end));
    for (double& x : all) x -= offset;
    return all;
}

Result<ContactSound> extractByFit(const std::vector<float>& samples, const HitExcerpt& hit, double rateHz,
                                  ExtractionBand band) {
    const std::size_t begin = hit.begin - std::min(hit.begin, toSamples(onsetReachSeconds, rateHz));
    const HitFit hitFit{copyExcerpt(samples, begin, hit.end, hit.offset), hit.begin - begin, rateHz};
    const std::vector<Partial> partials = hitFit.partials();
    std::vector<std::size_t> bandIndices;
    for (std::size_t k = 0; k < partials.size(); ++k) {
        const double hz = partials[k].omega / (2.0 * std::numbers::pi);
        if (hz >= band.lowHz && hz <= band.highHz && partials[k].tau >= HitFit::minTau)
            bandIndices.push_back(k);
    }
    if (bandIndices.empty()) return Failure{noSoundError(band)};
    std::ranges::stable_sort(bandIndices, std::greater{},
                             [&](std::size_t k) { return partials[k].spectralPeak(hitFit.seconds()); });
    const std::size_t best = bandIndices.front();
    const PartialError error = hitFit.stdError(best);
    const Partial& p = partials[best];
    ContactSound sound;
    sound.frequencyHz = p.omega / (2.0 * std::numbers::pi);
    sound.decayPerSecond = p.tau;
    sound.frequencyErrorHz = error.omega / (2.0 * std::numbers::pi);
    sound.decayErrorPerSecond = error.tau;
    sound.residualShare = hitFit.unexplainedEnergy() / hitFit.energy();
    sound.partialCount = static_cast<int>(partials.size());
    for (const std::size_t k : std::span(bandIndices).subspan(1))
        sound.furtherPartials.push_back({partials[k].omega / (2.0 * std::numbers::pi), partials[k].tau,
                                         partials[k].amplitude() / p.amplitude()});
    double explainedEnergy = 0.0;
    for (double t = 0.0; t < hitFit.seconds(); t += 1.0 / rateHz) explainedEnergy += p.value(t) * p.value(t);
    sound.explainedShare = explainedEnergy / hitFit.energy();
    sound.beginSeconds = static_cast<double>(begin) / rateHz + hitFit.onsetSeconds();
    sound.lengthSeconds = hitFit.seconds();
    return sound;
}

/// The two highest local maxima of |x| at least `minSeparationSeconds` from each other, in seconds, highest
/// first.
std::vector<Peak> twoHighestPeaks(std::vector<double> x, double rateHz, double minSeparationSeconds) {
    for (double& sample : x) sample = std::abs(sample);
    std::vector<Peak> all = findPeaks(x), peaks;
    std::ranges::sort(all, std::greater{}, &Peak::height);
    for (const Peak& peak : all) {
        const double seconds = peak.position / rateHz;
        if (peaks.size() < 2 &&
            (peaks.empty() || std::abs(seconds - peaks.front().position) >= minSeparationSeconds))
            peaks.push_back({seconds, peak.height});
    }
    return peaks;
}

Result<ContactSound> extractByTwoPeaks(const std::vector<float>& samples, const HitExcerpt& hit,
                                       double rateHz, ExtractionBand band) {
    const std::vector<double> x = copyExcerpt(samples, hit.begin, hit.end, hit.offset);
    ContactSound sound;
    sound.frequencyHz = highestPeakHz(x, rateHz, band.lowHz, band.highHz);
    const auto peaks = twoHighestPeaks(x, rateHz, 0.25 / sound.frequencyHz);
    if (peaks.size() < 2)
        return Failure{"two-peaks: expected two peaks in time, found " + std::to_string(peaks.size())};
    sound.decayPerSecond =
        std::log(peaks[0].height / peaks[1].height) / (peaks[1].position - peaks[0].position);
    if (!(sound.decayPerSecond > 0.0))
        return Failure{"two-peaks: expected the higher peak before the lower one, found it after"};
    sound.partialCount = 1;
    PartialFit fit{x, rateHz};
    fit.add({2.0 * std::numbers::pi * sound.frequencyHz, sound.decayPerSecond, 0.0, 0.0});
    fit.solveLinear();
    const auto count = static_cast<double>(x.size());
    const double energy = signalEnergy(x) / count * count; // as published figures were computed
    sound.residualShare = fit.residualEnergy() / energy;
    sound.explainedShare = 1.0 - sound.residualShare;
    sound.beginSeconds = static_cast<double>(hit.begin) / rateHz;
    sound.lengthSeconds = static_cast<double>(x.size()) / rateHz;
    return sound;
}

} // namespace

Result<ContactSound> extractMaterial(const std::vector<float>& samples, double rateHz, ExtractionBand band,
                                     MaterialRule rule) {
    if (auto error = inputError(samples, rateHz, band); !error.empty()) return Failure{std::move(error)};
    const HitExcerpt hit = strongestHit(samples, rateHz);
    if (static_cast<double>(hit.end - hit.begin) < minSeconds * rateHz)
        return Failure{"expected a hit and " + numberText(minSeconds) + " s after it, found its end" +
                       timeText(hit.end, rateHz)};
    return rule == MaterialRule::fit ? extractByFit(samples, hit, rateHz, band)
                                     : extractByTwoPeaks(samples, hit, rateHz, band);
}

} // namespace physvib
