// SPDX-License-Identifier: MIT
// Checks, then grains that stand out, then what repeats.
#include "Measure/TextureExtractor.h"
#include "Measure/GrainTrain.h"
#include "Measure/RecordingFaults.h"
#include "Measure/Repetition.h"
#include <algorithm>
#include <string>

namespace physvib {
namespace {

constexpr double shortestSeconds = 0.5, mostSeconds = 8.0;
constexpr std::size_t mostSamples = 400'000; // a second of arithmetic, 50 MB

std::vector<double> middleOf(const std::vector<float>& x, double rateHz) {
    const std::size_t size = std::min({x.size(), mostSamples, static_cast<std::size_t>(mostSeconds * rateHz)}), from = (x.size() - size) / 2;
    const auto begin = x.begin() + static_cast<std::ptrdiff_t>(from);
    return {begin, begin + static_cast<std::ptrdiff_t>(size)};
}

/// Ridges that are passed faster than what rings swings are hardly told from it: only their tone is certain.
void tellWhatRings(ScrapedTexture& found, const GrainTrain& train) {
    if (found.texture.pattern == GrainPattern::regular && found.grainsPerSecond > train.frequencyHz) return;
    found.frequencyHz = train.frequencyHz;
    found.decayPerSecond = train.decayPerSecond;
    found.strength = train.strength;
    found.counted = train.counted;
    found.lostShare = train.lostShare;
}

} // namespace

Result<ScrapedTexture> extractTexture(const std::vector<float>& samples, double rateHz, const Scrape& scrape) {
    if (auto fault = recordingFault(samples, rateHz, shortestSeconds); !fault.empty()) return Failure{std::move(fault)};
    if (isSilent(samples)) return Failure{"expected a scrape, found silence"};
    if (auto fault = clippingFault(samples, rateHz); !fault.empty()) return Failure{std::move(fault)};
    const std::vector<double> x = middleOf(samples, rateHz);
    const auto train = grainTrain(x, rateHz);
    const bool isRandom = train && train->isRandom(), isCounted = isRandom || (train && train->isEven());
    ScrapedTexture found;
    found.texture.pattern = isRandom ? GrainPattern::random : GrainPattern::regular;
    found.grainsPerSecond = isCounted ? train->perSecond : repetitionsPerSecond(x, rateHz);
    if (!(found.grainsPerSecond > 0.0)) return Failure{"expected a scrape whose grains stand out or repeat, found none that do"};
    if (isCounted) tellWhatRings(found, *train);
    found.texture.grainMetres = scrape.metresPerSecond / found.grainsPerSecond;
    if (found.strength > 0.0) found.texture.roughness = found.strength * scrape.massKg / grainImpulse(1.0, scrape.loadNewtons, scrape.metresPerSecond);
    if (const auto fault = faultOf(found.texture); !fault.empty()) return Failure{std::string{fault}};
    return found;
}

} // namespace physvib
