// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib thesis`: where each part of the thesis is, and figures that no other command draws.
#include "CommandLine/Command.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Core/Actuators/VibrationConverter.h"
#include "Io/Charts/Charts.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/StudyPlan.h"
#include "Lab/Thesis/ThesisPage.h"
#include "Live/Session/OfflineRender.h"
#include "Studies/StudyCalls.h"
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <regex>

namespace physvib {
namespace {

struct ThesisOptions {
    std::string place, folder; ///< empty place: all entries; empty folder: no files
};

constexpr int figureRateHz = 5000; // r_v of the thesis
constexpr double hitIntervalSeconds = 0.22, firstHitSeconds = 0.02;
using ThreeHits = std::array<std::size_t, 3>;

/// The stimuli of study 2 as published with that pair, by method; or the error of one that cannot be played.
Result<std::map<std::string, PlayableStimulus>> loadMethods(const std::string& pair) {
    const Protocol protocol = findProtocol("eight-methods-thesis").value;
    std::map<std::string, PlayableStimulus> methods;
    for (const PlannedStimulus& planned : plannedStimuli(protocol)) {
        const TrialJob job = planned.job(protocol);
        const std::string call = std::visit([](const auto& typedJob) { return textOf(typedJob); }, job);
        if (call.find("pair=" + pair) == std::string::npos || methods.contains(planned.label)) continue;
        auto playable = makePlayableStimulus(job, figureRateHz);
        if (!playable) return Failure{playable.error};
        methods.emplace(planned.label, std::move(playable.value));
    }
    return methods;
}

/// Events whose amplitudes are nearest to a quarter, a half and all of the strongest.
ThreeHits chooseThreeHits(const std::vector<CollisionEvent>& events) {
    const double maxAmplitude = std::ranges::max_element(events, {}, &CollisionEvent::amplitude)->amplitude;
    ThreeHits hits{};
    for (std::size_t k = 0; k < hits.size(); ++k) {
        const auto distance = [&](const CollisionEvent& e) {
            return std::abs(e.amplitude - maxAmplitude * (k == 2 ? 1.0 : 0.25 * static_cast<double>(k + 1)));
        };
        hits[k] = static_cast<std::size_t>(std::ranges::min_element(events, {}, distance) - events.begin());
    }
    return hits;
}

/// What the first actuator plays of these hits, one after the other, in g.
std::vector<double> renderHits(const PlayableStimulus& playable, const ThreeHits& hits) {
    std::vector<CollisionEvent> events;
    for (std::size_t k = 0; k < hits.size(); ++k) {
        events.push_back(playable.stimulus.events.at(hits[k]));
        events.back().timeNs =
            std::llround(1e9 * (firstHitSeconds + hitIntervalSeconds * static_cast<double>(k)));
    }
    std::vector<double> samples;
    const double unitG = playable.gains.front() * playable.layout.actuators.front().fullScaleG;
    renderOffline(events,
                  {.renderer = {figureRateHz, 0, playable.stimulus.panner, false},
                   .frames = std::llround(figureRateHz * hitIntervalSeconds * 3.0)},
                  [&](const float* const* channels, int frames) {
                      for (int n = 0; n < frames; ++n) samples.push_back(unitG * channels[0][n]);
                      return true;
                  });
    return samples;
}

LineSeries makeCurve(std::string name, const std::vector<double>& samples, std::size_t style, bool isThin) {
    LineSeries series{std::move(name), {}};
    series.hasMarkers = false;
    series.isThin = isThin;
    series.style = style;
    for (std::size_t n = 0; n < samples.size(); ++n)
        series.points.push_back(
            {1000.0 * static_cast<double>(n) / figureRateHz, ChartValue::withMargin(samples[n])});
    return series;
}

std::string drawEightMethods(ThesisPage& thesis) {
    const auto methods = loadMethods("steel-steel");
    if (!methods) return methods.error;
    const ThreeHits hits = chooseThreeHits(methods.value.at("AV-FV-DRV").stimulus.events);
    const auto variedSamples = renderHits(methods.value.at("AV-FV-DRV"), hits);
    const double strongestG = 1.2 * std::ranges::max(variedSamples);
    std::vector<std::string> charts;
    for (const auto& [name, playable] : methods.value) {
        const bool isFixed = name.starts_with("AF");
        LineChart chart{{"method" + std::to_string(charts.size()), name, false},
                        "time (ms)",
                        "acceleration (g)",
                        {makeCurve({}, renderHits(playable, hits), isFixed ? 4u : 0u, true)}};
        const double rangeG = isFixed ? 2.0 : strongestG;
        chart.yRange = {-rangeG, rangeG};
        chart.width = 335.0;
        chart.height = 240.0;
        charts.push_back(lineChart(chart));
    }
    thesis.page.addHeading("Eight methods (Fig. 5.12)");
    thesis.addFigure(
        "fig5-12", charts,
        "Three hits of eight-methods-thesis, steel can on steel wall, set 220 ms apart, as an "
        "actuator of 2 g plays them; axes of AF and AV differ. Printed: AF 1.5 g, FF 250 Hz, DRF 20 ms.");
    return {};
}

std::string drawOnOff(ThesisPage& thesis) {
    const auto methods = loadMethods("wood-wood");
    if (!methods) return methods.error;
    const PlayableStimulus& playable = methods.value.at("AV-FV-DRV");
    std::vector<double> wave = renderHits(playable, chooseThreeHits(playable.stimulus.events)), motor;
    const double peak = std::ranges::max(wave); // a decay's first half wave
    OnOffSteps steps{figureRateHz, OnOffSteps::thesisThreshold};
    for (double& sample : wave) {
        sample /= peak;
        steps.add(static_cast<float>(sample), [](long long, bool) {});
        motor.push_back(steps.isOn() ? 1.0 : 0.0);
    }
    LineChart chart{{"commands", "Commands for a wideband actuator and for a motor that is on or off", false},
                    "time (ms)",
                    "share of full scale",
                    {makeCurve("wideband actuator", wave, 0, true),
                     makeCurve("on or off, threshold 0.1", motor, 4, false)}};
    chart.yRange = {-1.0, 1.0};
    thesis.page.addHeading("Both commands (Fig. 5.4)");
    thesis.addFigure(
        "fig5-4", {lineChart(chart)},
        "Three hits of wood on wood, 220 ms apart, the strongest at full scale. A motor gets its word "
        "each 10 ms, for the 10 ms before. physvib render --pattern writes the same of a scene.");
    return {};
}

std::string describeEntry(const ThesisEntry& entry) {
    std::string text = entry.sections + ": " + entry.subject + "\n";
    for (const auto& [label, field] : {std::pair{"    ", &entry.call},
                                       {"    needs: ", &entry.requirements},
                                       {"    misprint: ", &entry.misprint},
                                       {"    differs: ", &entry.difference}})
        if (!field->empty()) text += label + *field + "\n";
    return text;
}

void declareThesis(OptionTable& command, ThesisOptions& o) {
    command.add("place", o.place, "a section, equation, figure or table, such as 5.3, 'Eq. 4.3'; all if none")
        .as("PLACE");
    command
        .add(
            "--out", o.folder,
            "the folder: index.html, thesis.csv, figures that no other command draws, printed numbers beside "
            "those reckoned, tests in R")
        .as("FOLDER");
}

int runThesis(const ThesisOptions& o) {
    if (!o.folder.empty()) {
        ThesisPage thesis = thesisPage();
        for (const auto draw : {drawOnOff, drawEightMethods})
            if (const std::string error = draw(thesis); !error.empty()) return reportExit(exitFailed, error);
        thesis.files["index.html"] = thesis.page.html();
        if (const int code = writeFolder(o.folder, thesis.files, {}); code != exitDone) return code;
        std::cout << (std::filesystem::path{o.folder} / "index.html").string() << "  " << thesis.files.size()
                  << " files\n";
        return exitDone;
    }
    std::string text; // place 5.3 also matches 5.3.1, but Fig. 5.1 not Fig. 5.10
    const std::regex pattern{", " + std::regex_replace(o.place, std::regex{"\\W"}, "\\$&") + "(?![0-9])"};
    for (const ThesisEntry& entry : thesisEntries())
        if (std::regex_search(", " + entry.sections, pattern)) text += describeEntry(entry);
    if (text.empty())
        return reportExit(exitUsage,
                          "thesis: expected a place such as 5.3, 'Fig. 4.9' or 'Table 5.1', found " +
                              inQuotes(o.place));
    std::cout << text;
    return exitDone;
}

} // namespace

Command thesisCommand() {
    return makeCommand("thesis", "each part of the thesis, and the call that reproduces it", declareThesis,
                       runThesis);
}

} // namespace physvib
