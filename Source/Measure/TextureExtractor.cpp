// SPDX-License-Identifier: MIT
// Extraction of a texture: checks the recording, counts grains that stand out, else looks for repetition.
#include "Measure/TextureExtractor.h"
#include "Measure/GrainTrain.h"
#include "Measure/HitExcerpt.h"
#include "Measure/Spectrum.h"
#include <algorithm>
#include <string>

namespace physvib {
namespace {

constexpr double shortestSeconds = 0.5, mostSeconds = 8.0;
constexpr std::size_t mostSamples = 400'000; // a second of computing, 50 MB

std::vector<double> middleOf(const std::vector<float>& x, double rateHz) {
    const std::size_t size =
                          std::min({x.size(), mostSamples, static_cast<std::size_t>(mostSeconds * rateHz)}),
                      from = (x.size() - size) / 2;
    const auto begin = x.begin() + static_cast<std::ptrdiff_t>(from);
    return {begin, begin + static_cast<std::ptrdiff_t>(size)};
}

/// Autocorrelation normalised by the energy of the stronger of the two overlapping parts, so that a decaying
/// signal does not look similar to itself.
std::vector<double> likenessOf(std::span<const double> x) {
    std::vector<double> likeness = autocorrelation(x), energy{0.0};
    for (const double sample : x) energy.push_back(energy.back() + sample * sample);
    for (std::size_t lag = 0; lag < likeness.size(); ++lag) {
        const double stronger = std::max(energy[x.size() - lag], energy[x.size()] - energy[lag]);
        likeness[lag] = stronger > 0.0 ? likeness[lag] / stronger : 0.0;
    }
    return likeness;
}

Peak highestWithin(std::span<const double> x, std::size_t from, std::size_t to) {
    return vertex(x, static_cast<std::size_t>(std::max_element(x.begin() + static_cast<std::ptrdiff_t>(from),
                                                               x.begin() + static_cast<std::ptrdiff_t>(to)) -
                                              x.begin()));
}

/// Rate of a steady repetition (within 0.1 %), as of ridges that are passed too fast to be separated from the
/// resonance; 0 if there is none. Uses the autocorrelation of the slope: at large lags the resonance has
/// decayed, the repetition has not.
double repetitionsPerSecond(std::span<const double> samples, double rateHz) {
    constexpr double smoothSeconds = 0.00025, leastLikeness = 0.6;
    const std::vector<double> slope = smoothSlope(samples, rateHz, smoothSeconds);
    if (slope.size() < 200) return 0.0;
    // without the start of the recording
    const auto likeness = likenessOf(std::span{slope}.subspan(slope.size() / 5));
    const std::size_t n = likeness.size();
    const double far = highestWithin(likeness, n / 4, n / 2).height; // at such lags a resonance has decayed
    if (far < leastLikeness) return 0.0;
    double lag = 0.0;
    for (std::size_t i = 1; lag == 0.0 && i + 1 < n / 2; ++i)
        if (isPeak(likeness, i))
            if (const Peak peak = vertex(likeness, i); peak.height >= 1.0 - 3.0 * (1.0 - far) - 0.003)
                lag = peak.at;
    // larger multiples of the lag make it more precise
    for (double times = 2.0; lag > 4.0 && lag * times < 0.5 * static_cast<double>(n) - lag; times *= 2.0)
        lag = highestWithin(likeness, static_cast<std::size_t>((times - 0.25) * lag),
                            static_cast<std::size_t>((times + 0.25) * lag) + 2)
                  .at /
              times;
    return lag > 4.0 ? rateHz / lag : 0.0;
}

/// If ridges pass at more than the resonance, both are hard to separate: only the repetition rate is certain.
void tellWhatRings(ScrapedTexture& found, const GrainTrain& train) {
    if (found.texture.pattern == GrainPattern::regular && found.grainsPerSecond > train.frequencyHz) return;
    found.frequencyHz = train.frequencyHz;
    found.decayPerSecond = train.decayPerSecond;
    found.strength = train.strength;
    found.counted = train.counted;
    found.lostShare = train.lostShare;
}

} // namespace

Result<ScrapedTexture> extractTexture(const std::vector<float>& samples, double rateHz,
                                      const Scrape& scrape) {
    if (auto fault = recordingFault(samples, rateHz, shortestSeconds); !fault.empty())
        return Failure{std::move(fault)};
    if (isSilent(samples)) return Failure{"expected a scrape, found silence"};
    if (auto fault = clippingFault(samples, rateHz); !fault.empty()) return Failure{std::move(fault)};
    const std::vector<double> x = middleOf(samples, rateHz);
    const auto train = grainTrain(x, rateHz);
    const bool isRandom = train && train->isRandom(), isCounted = isRandom || (train && train->isEven());
    ScrapedTexture found;
    found.texture.pattern = isRandom ? GrainPattern::random : GrainPattern::regular;
    found.grainsPerSecond = isCounted ? train->perSecond : repetitionsPerSecond(x, rateHz);
    if (!(found.grainsPerSecond > 0.0))
        return Failure{"expected a scrape whose grains stand out or repeat, found none that do"};
    if (isCounted) tellWhatRings(found, *train);
    found.texture.grainMetres = scrape.metresPerSecond / found.grainsPerSecond;
    if (found.strength > 0.0)
        found.texture.roughness =
            found.strength * scrape.massKg / grainImpulse(1.0, scrape.loadNewtons, scrape.metresPerSecond);
    if (const auto fault = faultOf(found.texture); !fault.empty()) return Failure{std::string{fault}};
    return found;
}

} // namespace physvib
