// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `physvib stimulus`, from words to a stimulus.
#include "CommandLine/Study/StimulusOptions.h"
#include "Core/Limits.h"
#include "Core/SamplePeak.h"
#include "Files/ActuatorFile.h"
#include "Files/Text/NumberText.h"
#include "Host/Recordings/ReadRecording.h"
#include "Options/OptionTable.h"
#include "Study/PercentCounts.h"
#include <cmath>
#include <filesystem>
#include <optional>

namespace physvib {
namespace {

bool splitPair(const std::string& text, char separator, double& first, double& second) {
    const std::size_t at = text.find(separator);
    if (at == std::string::npos) return false;
    const auto a = parseNumber<double>(std::string_view{text}.substr(0, at)), b = parseNumber<double>(std::string_view{text}.substr(at + 1));
    if (a) first = *a;
    if (b) second = *b;
    return a && b;
}

/// Where a phantom shall be; what is wrong with the call.
std::string findPlace(const StimulusOptions& o, FieldPlace& place) {
    if (o.at.empty() == o.cell.empty()) return "give either --at X,Y or --grid CxR with --cell r,c";
    if (!o.at.empty()) {
        const bool isRead = splitPair(o.at, ',', place.x, place.y) && place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1;
        return isRead ? "" : "--at: expected X,Y from 0 to 1, found " + inQuotes(o.at);
    }
    double columns = 0, rows = 0;
    const auto isSize = [](double n) { return n >= 1 && n <= static_cast<double>(mostGridLines) && n == std::floor(n); };
    if (!splitPair(o.grid, 'x', columns, rows) || !isSize(columns) || !isSize(rows)) return "--grid: expected COLUMNSxROWS like 7x5, found " + inQuotes(o.grid);
    const PhantomGrid grid{static_cast<int>(columns), static_cast<int>(rows), o.points == "middles" ? PhantomGrid::Points::middles : PhantomGrid::Points::corners};
    const auto cell = parseGridCell(o.cell);
    if (!cell || cell->column > grid.columns || cell->row > grid.rows) return "--cell: expected r,c of the grid (row 1 is the upper one), found " + inQuotes(o.cell);
    place = grid.place(*cell);
    return {};
}

/// The one resonance of all enchanters: a phantom is one vibration.
Result<double> resonanceOf(const LayoutDescription& layout) {
    std::optional<double> found;
    for (const auto& enchanter : layout.enchanters) {
        const auto fail = [&](const std::string& why) { return Failure{"--frequency resonance: enchanter " + enchanter.label + ": " + why}; };
        if (enchanter.actuator == "none") return fail("expected an actuator, found none");
        const auto profile = findActuator(enchanter.actuator);
        if (!profile) return fail(profile.error);
        if (!profile.value.resonanceHz) return fail(profile.value.name + ": resonance_hz is not known (measure it with physvib calibrate)");
        if (*profile.value.resonanceHz < limits::slowestToneHz) return fail("expected at least " + numberText(limits::slowestToneHz) + " Hz, found " + numberText(*profile.value.resonanceHz) + " Hz");
        if (found && *found != *profile.value.resonanceHz) return fail("expected the resonance of the others, " + numberText(*found) + " Hz, found " + numberText(*profile.value.resonanceHz) + " Hz");
        found = profile.value.resonanceHz;
    }
    return *found;
}

std::string findFrequency(const StimulusOptions& o, const LayoutDescription& layout, MadeStimulus& made, double& frequencyHz) {
    if (o.frequency == "resonance") {
        const auto resonance = resonanceOf(layout);
        made.error = resonance.error;
        frequencyHz = resonance.value;
        return {};
    }
    frequencyHz = parseNumber<double>(o.frequency).value_or(0.0);
    const bool isInRange = frequencyHz >= limits::slowestToneHz && frequencyHz <= limits::maxFrequencyHz;
    return isInRange ? "" : "--frequency: expected " + numberText(limits::slowestToneHz) + " to " + numberText(limits::maxFrequencyHz) + " Hz, or resonance, found " + inQuotes(o.frequency);
}

std::string makePattern(const StimulusOptions& o, const LayoutDescription& layout, MadeStimulus& made) {
    const auto pattern = parsePatternLabel(o.pattern);
    const int enchanters = layout.geometry.count;
    if (!pattern) return "expected a pattern like ABA-250 (one to three enchanters, then milliseconds), found " + inQuotes(o.pattern);
    for (int k = 0; k < pattern->count; ++k)
        if (pattern->enchanters[static_cast<std::size_t>(k)] >= enchanters)
            return "expected enchanters among the " + std::to_string(enchanters) + " of the layout, found " + inQuotes(o.pattern);
    double frequencyHz = 0.0;
    if (auto refusal = findFrequency(o, layout, made, frequencyHz); !refusal.empty() || !made.error.empty()) return refusal;
    made.stimulus = patternStimulus(*pattern, enchanters, {frequencyHz, o.levelG}, o.gapSeconds);
    made.title = o.pattern;
    return {};
}

std::string makePhantom(const StimulusOptions& o, const LayoutDescription& layout, MadeStimulus& made) {
    FieldPlace place;
    PanningLaw law;
    if (auto refusal = findPlace(o, place); !refusal.empty()) return refusal;
    if (!panningLawNamed(o.law, law)) return "--law: expected linear, log, log-outer or energy, found " + inQuotes(o.law);
    const PhantomPanner panner{layout.geometry, law, o.exponent, layout.geometry.extentWidthMetres, layout.geometry.extentHeightMetres};
    made.title = o.cell.empty() ? "phantom at " + o.at : "phantom " + o.cell + " of " + o.grid;
    double frequencyHz = 0.0;
    if (auto refusal = findFrequency(o, layout, made, frequencyHz); !refusal.empty() || !made.error.empty()) return refusal;
    made.stimulus = phantomStimulus(place, layout.geometry, law, o.exponent, {frequencyHz, o.levelG}, o.seconds);
    if (o.recording.empty()) return {};
    made.title = std::filesystem::path{o.recording}.filename().string();
    made.stimulus.events.clear();
    auto recording = readRecording(o.recording);
    if (!recording) {
        made.error = recording.error;
    } else if (recording.value.channels.size() != 1) {
        made.error = o.recording + ": expected one channel, found " + std::to_string(recording.value.channels.size());
    } else {
        made.note = takeSlowPart(recording.value, o.recording, peakOf(recording.value.channels.front()));
        auto placed = placeRecording(recording.value, place, o.levelG, panner, layout);
        made.error = placed.error;
        made.sound = std::move(placed.value);
    }
    return {};
}

void declarePlace(OptionTable& command, StimulusOptions& o) {
    command.add("--at", o.at, "place on the field: right and down, from 0 to 1").as("X,Y");
    command.add("--grid", o.grid, "columns and rows of a grid, e.g. 7x5").as("CxR");
    command.add("--cell", o.cell, "row and column in the grid, from 1, row 1 above").as("r,c");
    command.add("--points", o.points, "the grid's points: its outer ones on the corners, or the middles of cells").oneOf({"corners", "middles"});
    command.add("--law", o.law, "panning law: linear, log, log-outer, energy");
    command.add("--exponent", o.exponent, "exponent of the law").in(0.01, 100.0);
}

void declareCarrier(OptionTable& command, StimulusOptions& o) {
    command.add("--frequency", o.frequency, "Hz, or resonance: that of the layout's actuators");
    command.add("--rate", o.sampleRateHz, "sample rate").in(limits::minSampleRateHz, limits::maxSampleRateHz);
}

} // namespace

void declareStimulus(OptionTable& command, StimulusOptions& o) {
    OptionTable& pattern = command.addCommand("pattern", "a spatiotemporal pattern of pulses");
    OptionTable& phantom = command.addCommand("phantom", "a stationary phantom between the enchanters");
    OptionTable& wav = command.addCommand("wav", "a recording or a haptic file as a phantom, at its own rate");
    wav.alias = "clip";
    OptionTable& all = command.addCommand("list", "the labels of all patterns, one per line");
    pattern.add("pattern", o.pattern, "enchanters in the order of the pulses, and a pulse's ms").required().as("ABA-250");
    pattern.add("--gap", o.gapSeconds, "silence between pulses, s").in(0.0, 10.0);
    wav.add("recording", o.recording, "one channel").required().as("FILE.wav");
    phantom.add("--seconds", o.seconds, "length").in(0.001, 600.0);
    all.add("--enchanters", o.enchanters, "how many").in(1, 26);
    for (OptionTable* const one : {&pattern, &phantom}) declareCarrier(*one, o);
    for (OptionTable* const one : {&phantom, &wav}) declarePlace(*one, o);
    for (OptionTable* const one : {&pattern, &phantom, &wav}) {
        one->add("--layout", o.layout, "phone1..phone4, ring1..ring4, study1 or a layout file");
        one->add("--level-g", o.levelG, "peak acceleration at gain 1, in g").in(1e-6, 1000.0);
        one->add("--out", o.wavPath, "32-bit float WAV, one channel per enchanter, 1 = its full scale").written("FILE.wav");
        one->add("--picture", o.picturePath, "what each enchanter plays").written("FILE.png");
    }
}

MadeStimulus makeStimulus(const OptionTable& command, const StimulusOptions& o, const LayoutDescription& layout) {
    MadeStimulus made;
    made.usage = command.isCalled("pattern") ? makePattern(o, layout, made) : makePhantom(o, layout, made);
    return made;
}

} // namespace physvib
