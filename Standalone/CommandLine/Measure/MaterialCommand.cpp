// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib material`: measures frequency and decay of a recorded contact, and their confidence.
#include "CommandLine/Command.h"
#include "CommandLine/Measure/RecordingList.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Io/Charts/Charts.h"
#include "Io/Text/NumberText.h"
#include "Live/Recordings/ReadRecording.h"
#include "Measure/HitExcerpt.h"
#include "Measure/MaterialExtractor.h"
#include "Measure/Spectrum.h"
#include "Measure/TextureExtractor.h"
#include "Scene/MaterialTable.h"
#include "Scene/SceneFields.h"
#include "System/Process.h"
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>
#include <ranges>
#include <string>
#include <tuple>
#include <vector>

namespace physvib {
namespace {

std::string conditionsText(const Scrape& scrape) {
    return numberText(scrape.metresPerSecond) + " m/s, " + numberText(scrape.loadNewtons) + " N and " +
           numberText(scrape.massKg) + " kg";
}

std::string measurementText(const ScrapedTexture& f, const Scrape& scrape) {
    std::string text = fixedNumber(f.grainsPerSecond, 1) + " grains a second, ";
    text += f.grainCount > 0 ? std::to_string(f.grainCount) + " counted, " +
                                   fixedNumber(100.0 * f.lostShare, 1) + " % taken to be hidden"
                             : "by their tone alone";
    return text + (f.strength > 0.0
                       ? "; " + fixedNumber(100.0 * f.strength, 2) +
                             " % of full scale each; roughness as if recorded at 1 for 1 N s on 1 kg, for " +
                             conditionsText(scrape)
                       : "; modes and roughness cannot be measured at this speed: scrape more slowly");
}

/// Measures a recorded scrape and prints its texture as a table. Returns an exit code.
int printTexture(const std::string& path, const Scrape& scrape) {
    const auto recording = readRecording(path);
    if (!recording) return reportExit(exitFailed, recording.error);
    const auto extraction =
        extractTexture(loudestChannel(recording.value.channels), recording.value.sampleRateHz, scrape);
    if (!extraction) return reportExit(exitFailed, path + ": " + extraction.error);
    const ScrapedTexture& f = extraction.value;
    const auto orEmpty = [&](double number) { return f.strength > 0.0 ? numberText(number) : std::string{}; };
    std::cout << "frequency_hz,decay_per_s,grain_m,roughness,grain_pattern\n"
              << orEmpty(f.frequencyHz) << ',' << orEmpty(f.decayPerSecond) << ','
              << numberText(f.texture.grainMetres) << ',' << orEmpty(f.texture.roughness) << ','
              << grainPatternNames[static_cast<std::size_t>(f.texture.pattern)] << '\n';
    std::cerr << "physvib: " << measurementText(f, scrape) << '\n';
    return exitDone;
}

struct MaterialOptions {
    std::string path;
    std::string band = "20-1000"; ///< "LO-HI" in Hz
    std::string rule = "fit";     ///< or "two-peaks"
    int modes = 1;
    bool listsMaterials = false; ///< list the built-in materials
    std::string picturePath;     ///< empty: none
    std::string texturePath;     ///< a scrape recording, instead of an impact
    std::optional<double> speedMetresPerSecond;
    double loadNewtons = 1.0, massKg = 1.0;
};

int listMaterials() {
    std::string text;
    for (const MaterialTable& table : builtInMaterials()) {
        text += "# " + table.source + '\n';
        if (&table == &builtInMaterials().front()) text += "material,frequency_hz,decay_per_s\n";
        for (const Material& m : table.materials)
            if (m.frequencyHz > 0.0)
                text += m.name + "," + numberText(m.frequencyHz) + "," + numberText(m.decayPerSecond) + "\n";
    }
    std::cout << text;
    return exitDone;
}

std::string significantText(double number) { return fixedNumber(number, number < 0.1 ? 4 : 2); }

std::string confidenceText(const ContactSound& sound) {
    std::string text = fixedNumber(sound.frequencyHz, 2) + " Hz";
    if (sound.frequencyErrorHz > 0.0) text += " +- " + significantText(sound.frequencyErrorHz);
    text += ", " + fixedNumber(sound.decayPerSecond, 2) + " /s";
    if (sound.decayErrorPerSecond > 0.0) text += " +- " + significantText(sound.decayErrorPerSecond);
    text += "; residual " + (sound.residualShare > 0.0
                                 ? fixedNumber(10.0 * std::log10(sound.residualShare), 1) + " dB"
                                 : std::string{"none"});
    return text + "; " + plural(static_cast<std::size_t>(sound.partialCount), "partial") + " in " +
           fixedNumber(sound.lengthSeconds, 3) + " s from " + fixedNumber(sound.beginSeconds, 4) +
           " s; confidence " + (sound.isConfident() ? "high" : "low");
}

/// Scales the values to a peak of 1, as in thesis Fig. 5.7.
void normalise(std::vector<double>& values) {
    const double peak = std::abs(*std::ranges::max_element(values, {}, [](double x) { return std::abs(x); }));
    for (double& value : values) value /= peak > 0.0 ? peak : 1.0;
}

/// Draws waveform and spectrum as SVG, from the contact's start until its mode has fallen to a hundredth.
std::string drawContact(const std::vector<float>& samples, double rateHz, const ContactSound& sound,
                        const ExtractionBand& band) {
    constexpr double maxSeconds = 0.5;
    const auto first = static_cast<std::size_t>(std::max(0.0, sound.beginSeconds) * rateHz);
    const double seconds = std::min(maxSeconds, std::log(100.0) / std::max(1.0, sound.decayPerSecond));
    std::vector<double> contact, mode;
    for (std::size_t n = 0; first + n < samples.size() && static_cast<double>(n) < seconds * rateHz; ++n) {
        const double t = static_cast<double>(n) / rateHz;
        contact.push_back(static_cast<double>(samples[first + n]));
        mode.push_back(std::sin(2.0 * std::numbers::pi * sound.frequencyHz * t) *
                       std::exp(-sound.decayPerSecond * t));
    }
    LineChart waveformChart{{"wave", "Waveform", false}, "time (ms)", "share of the peak", {}},
        spectrumChart{{"bins", "Spectrum", false}, "frequency (Hz)", "share of the peak", {}};
    for (auto& [label, values, style] : {std::tuple{"recorded", &contact, 0u}, {"its mode", &mode, 4u}}) {
        std::vector<double> spectrum = magnitudes(*values);
        const double binHz = 0.5 * rateHz / static_cast<double>(spectrum.size() - 1);
        normalise(*values);
        normalise(spectrum);
        LineSeries waveform{label, {}}, magnitude{label, {}};
        for (std::size_t n = 0; n < values->size(); ++n)
            waveform.points.push_back(
                {1000.0 * static_cast<double>(n) / rateHz, ChartValue::withMargin((*values)[n])});
        for (std::size_t k = 0; k < spectrum.size() && static_cast<double>(k) * binHz <= 2.0 * band.highHz;
             ++k)
            magnitude.points.push_back({static_cast<double>(k) * binHz, ChartValue::withMargin(spectrum[k])});
        for (auto [series, chart] : {std::pair{&waveform, &waveformChart}, {&magnitude, &spectrumChart}}) {
            series->hasMarkers = false;
            series->isThin = true;
            series->style = style;
            chart->series.push_back(std::move(*series));
        }
    }
    spectrumChart.threshold = ChartValue{sound.frequencyHz, band.lowHz, band.highHz};
    spectrumChart.thresholdLabel = fixedNumber(sound.frequencyHz, 1) + " Hz, in the band";
    return chartSheet({lineChart(waveformChart), lineChart(spectrumChart)});
}

void declareMaterial(OptionTable& command, MaterialOptions& o) {
    command.add("recording", o.path, "one contact; of several, the strongest is taken").as("FILE.wav");
    command.add("--band", o.band, "Hz within which the frequency is looked for").as("LO-HI");
    command.add("--rule", o.rule, "fit of decaying partials, or the thesis' two-peaks")
        .oneOf({"fit", "two-peaks"});
    command.add("--modes", o.modes, "partials to be printed, the strongest first: a body's overtones")
        .as("N")
        .in(1, 4);
    command
        .add("--picture", o.picturePath,
             "waveform and spectrum of the contact, and of the mode that was found, with the band")
        .outputFileNamed("FILE.svg");
    command.add("--texture", o.texturePath, "a scrape at a steady speed: grains instead of one contact")
        .as("FILE.wav");
    command.add("--speed", o.speedMetresPerSecond, "m/s at which it was scraped").as("V").in(0.001, 100.0);
    command.add("--load", o.loadNewtons, "N that pressed").as("N").in(0.001, 1000.0);
    command.add("--mass", o.massKg, "kg of what vibrated").as("KG").in(0.0001, 10000.0);
    command.add("--list", o.listsMaterials,
                "the built-in materials that sound, and where their numbers are from");
}

int runMaterial(const MaterialOptions& o) {
    if ((o.listsMaterials ? 1 : 0) + (o.path.empty() ? 0 : 1) + (o.texturePath.empty() ? 0 : 1) != 1)
        return reportExit(exitUsage, "material: give either FILE.wav or --list or --texture FILE");
    if (!o.picturePath.empty() && o.path.empty())
        return reportExit(exitUsage, "material: --picture goes with FILE.wav");
    if (o.texturePath.empty() == o.speedMetresPerSecond.has_value())
        return reportExit(exitUsage, "material: --texture and --speed go together");
    if (o.listsMaterials) return listMaterials();
    if (!o.texturePath.empty())
        return printTexture(o.texturePath, {*o.speedMetresPerSecond, o.loadNewtons, o.massKg});
    const auto band = parseBand(o.band);
    if (!band) return reportExit(exitUsage, band.error);
    const auto recording = readRecording(o.path);
    if (!recording) return reportExit(exitFailed, recording.error);
    const auto sound = extractMaterial(loudestChannel(recording.value.channels), recording.value.sampleRateHz,
                                       {band.value.lowHz, band.value.highHz},
                                       o.rule == "fit" ? MaterialRule::fit : MaterialRule::twoPeaks);
    if (!sound) return reportExit(exitFailed, o.path + ": " + sound.error);
    const int code =
        writeStudyFiles({StudyFile{o.picturePath, [&] {
                                       return drawContact(loudestChannel(recording.value.channels),
                                                          recording.value.sampleRateHz, sound.value,
                                                          {band.value.lowHz, band.value.highHz});
                                   }}});
    if (code != exitDone) return code;
    const auto rowText = [](double hz, double perSecond) {
        return numberText(hz) + ',' + numberText(perSecond);
    };
    const bool hasAmplitudes = o.modes > 1;
    std::cout << "frequency_hz,decay_per_s" << (hasAmplitudes ? ",amplitude\n" : "\n")
              << rowText(sound.value.frequencyHz, sound.value.decayPerSecond)
              << (hasAmplitudes ? ",1\n" : "\n");
    for (const FurtherPartial& partial : sound.value.furtherPartials | std::views::take(o.modes - 1))
        std::cout << rowText(partial.frequencyHz, partial.decayPerSecond) << ','
                  << numberText(partial.amplitude) << '\n';
    std::cerr << "physvib: " << confidenceText(sound.value) << '\n';
    return exitDone;
}

} // namespace

Command materialCommand() {
    return makeCommand("material", "frequency and decay of a recorded contact", declareMaterial, runMaterial);
}

} // namespace physvib
