// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates surface grains from a file, and prints the result with its confidence.
#include "CommandLine/Measure/TextureText.h"
#include "Formats/TextureModels.h"
#include "Host/Recordings/ReadRecording.h"
#include "Io/Text/NumberText.h"
#include "Measure/LoudestChannel.h"
#include "Scene/SceneFields.h"
#include "System/ExitCode.h"
#include <iostream>

namespace physvib {
namespace {

struct Told {
    ScrapedTexture found;
    std::string about; ///< description in one line
};

std::string conditions(const Scrape& scrape) {
    return numberText(scrape.metresPerSecond) + " m/s, " + numberText(scrape.loadNewtons) + " N and " +
           numberText(scrape.massKg) + " kg";
}

Result<Told> ofRecording(const std::string& path, const Scrape& scrape) {
    const auto recording = readRecording(path);
    if (!recording) return Failure{recording.error};
    const auto found =
        extractTexture(loudestOf(recording.value.channels), recording.value.sampleRateHz, scrape);
    if (!found) return Failure{path + ": " + found.error};
    const ScrapedTexture& f = found.value;
    std::string about = fixedNumber(f.grainsPerSecond, 1) + " grains a second, ";
    about += f.counted > 0 ? std::to_string(f.counted) + " counted, " + fixedNumber(100.0 * f.lostShare, 1) +
                                 " % taken to be hidden"
                           : "by their tone alone";
    about += f.strength > 0.0
                 ? "; " + fixedNumber(100.0 * f.strength, 2) +
                       " % of full scale each; roughness as if recorded at 1 for 1 N s on 1 kg, for " +
                       conditions(scrape)
                 : "; modes and roughness cannot be measured at this speed: scrape more slowly";
    return Told{f, std::move(about)};
}

Result<Told> ofModels(const std::string& path, const Scrape& scrape) {
    const auto models = loadTextureModels(path);
    if (!models) return Failure{models.error};
    const TextureModel& model = models.value.nearest(scrape.metresPerSecond, scrape.loadNewtons);
    const Scrape recorded{model.metresPerSecond, model.newtons, scrape.massKg};
    if (!(recorded.metresPerSecond > 0.0) || !(recorded.loadNewtons > 0.0))
        return Failure{path + ": expected a model of a speed and a force above 0, found none near " +
                       conditions(scrape)};
    const auto found = textureOf({models.value.sampleRateHz, model.variance, model.coefficients}, recorded);
    if (!found) return Failure{path + ": " + found.error};
    return Told{found.value, "the model of " + conditions(recorded) + ", of " +
                                 std::to_string(models.value.models.size()) +
                                 "; spacing and pattern are ours, a model has none"};
}

} // namespace

int tellTexture(const std::string& path, const Scrape& scrape) {
    const Result<Told> told = isTextureModels(path) ? ofModels(path, scrape) : ofRecording(path, scrape);
    if (!told) return leave(exitFailed, told.error);
    const ScrapedTexture& f = told.value.found;
    const auto known = [&](double number) { return f.strength > 0.0 ? numberText(number) : std::string{}; };
    std::cout << "frequency_hz,decay_per_s,grain_m,roughness,grain_pattern\n"
              << known(f.frequencyHz) << ',' << known(f.decayPerSecond) << ','
              << numberText(f.texture.grainMetres) << ',' << known(f.texture.roughness) << ','
              << grainPatternNames[static_cast<std::size_t>(f.texture.pattern)] << '\n';
    std::cerr << "physvib: " << told.value.about << '\n';
    return exitDone;
}

} // namespace physvib
