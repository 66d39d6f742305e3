// SPDX-License-Identifier: GPL-3.0-or-later
// Declares and parses the options of `physvib stimulus`.
#include "Calls/StimulusOptions.h"
#include "Calls/RenderOptions.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Identification.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

namespace words = stimulusWords;
namespace ranges = stimulusRanges;

bool splitPair(const std::string& text, char separator, double& first, double& second) {
    const std::size_t at = text.find(separator);
    if (at == std::string::npos) return false;
    const auto a = parseNumber<double>(std::string_view{text}.substr(0, at)),
               b = parseNumber<double>(std::string_view{text}.substr(at + 1));
    if (a) first = *a;
    if (b) second = *b;
    return a && b;
}

/// Unreadable text gives an invalid place.
FieldPlace placeAt(const std::string& text) {
    FieldPlace place;
    return splitPair(text, ',', place.x, place.y) ? place : FieldPlace{-1.0, -1.0};
}

GridPlace gridPlace(const StimulusOptions& o) {
    double columns = 0.0, rows = 0.0;
    const auto lines = [](double n) {
        return n >= 1.0 && n <= static_cast<double>(mostGridLines) && n == std::floor(n) ? static_cast<int>(n)
                                                                                         : 0;
    };
    if (!splitPair(o.grid, 'x', columns, rows)) columns = rows = 0.0;
    return {{lines(columns), lines(rows),
             o.points == "middles" ? PhantomGrid::Points::middles : PhantomGrid::Points::corners},
            parseGridCell(o.cell).value_or(GridCell{})};
}

/// The text given for an option.
const std::string& saidOf(const StimulusOptions& o, std::string_view word) {
    return word == words::at          ? o.at
           : word == words::grid      ? o.grid
           : word == words::cell      ? o.cell
           : word == words::frequency ? o.frequency
                                      : o.pattern.label;
}

void declarePlace(OptionTable& command, StimulusOptions& o) {
    command.add(words::at, o.at, "place on the field: right and down, from 0 to 1").as("X,Y");
    command.add(words::grid, o.grid, "columns and rows of a grid, e.g. 7x5").as("CxR");
    command.add(words::cell, o.cell, "row and column in the grid, from 1, row 1 above").as("r,c");
    command
        .add(words::points, o.points,
             "the grid's points: its outer ones on the corners, or the middles of cells")
        .oneOf({"corners", "middles"});
    addLaw(command, o.phantom.law);
    command.add(words::exponent, o.phantom.exponent, "exponent of the law")
        .in(ranges::exponent.least, ranges::exponent.most);
}

void declareCarrier(OptionTable& command, StimulusOptions& o) {
    command.add(words::frequency, o.frequency, "Hz, or resonance: that of the layout's actuators");
    command.add("--rate", o.sampleRateHz, "sample rate").in(limits::minSampleRateHz, limits::maxSampleRateHz);
}

} // namespace

void declareStimulus(OptionTable& command, StimulusOptions& o) {
    OptionTable& pattern = command.addCommand("pattern", "a spatiotemporal pattern of pulses");
    OptionTable& phantom = command.addCommand("phantom", "a stationary phantom between the actuators");
    OptionTable& wav =
        command.addCommand("wav", "a recording or a haptic file as a phantom, at its own rate");
    wav.alias = "clip";
    OptionTable& all = command.addCommand("list", "the labels of all patterns, one per line");
    pattern.add("pattern", o.pattern.label, "actuators in the order of the pulses, and a pulse's ms")
        .required()
        .as("ABA-250");
    pattern.add(words::gap, o.pattern.gapSeconds, "silence between pulses, s")
        .in(ranges::gapSeconds.least, ranges::gapSeconds.most);
    wav.add("recording", o.phantom.recording, "one channel").required().as("FILE.wav");
    phantom.add(words::seconds, o.phantom.seconds, "length").in(ranges::seconds.least, ranges::seconds.most);
    phantom.add(words::decay, o.phantom.decayPerSecond, "decay of the amplitude, 1/s; 0: a burst")
        .in(ranges::decayPerSecond.least, ranges::decayPerSecond.most);
    phantom
        .add(
            words::levelOf, o.levelOf,
            "--level-g is the peak, or that of a burst of the same rms over the length, of a burst of 1 s of "
            "the same energy, or of a burst whose rms is that behind the hand-arm weighting of ISO 5349-1")
        .oneOf({levelOfNames.begin(), levelOfNames.end()});
    all.add("--enchanters", o.enchanters, "how many").in(1, 26);
    for (OptionTable* const one : {&pattern, &phantom}) declareCarrier(*one, o);
    for (OptionTable* const one : {&phantom, &wav}) declarePlace(*one, o);
    for (OptionTable* const one : {&pattern, &phantom, &wav}) {
        one->add(words::layout, o.job.layout,
                 listedByNumber(layoutPresetNames) + ", study1 or a layout file");
        one->add(words::levelG, o.job.levelG, "peak acceleration at gain 1, in g")
            .in(ranges::levelG.least, ranges::levelG.most);
        one->add("--out", o.wavPath, "32-bit float WAV, one channel per actuator, 1 = its full scale")
            .written("FILE.wav");
        one->add("--picture", o.picturePath, "what each actuator plays").writtenAs("FILE.png");
    }
}

Result<StimulusJob> readStimulus(const OptionTable& command, const StimulusOptions& o) {
    StimulusJob job = o.job;
    job.frequencyHz = parseNumber<double>(o.frequency).value_or(0.0);
    if (o.frequency == words::resonance) job.frequencyHz.reset();
    job.what = o.pattern;
    if (!command.isCalled("pattern")) {
        if (o.at.empty() == o.cell.empty())
            return Failure{"give either --at X,Y or --grid CxR with --cell r,c"};
        auto& phantom = job.what.emplace<PhantomJob>(o.phantom);
        phantom.levelOf =
            static_cast<LevelOf>(std::ranges::find(levelOfNames, o.levelOf) - levelOfNames.begin());
        if (o.at.empty())
            phantom.at = gridPlace(o);
        else
            phantom.at = placeAt(o.at);
    }
    const JobFault fault = faultOf(job);
    if (fault) return Failure{fault.words() + ", found " + inQuotes(saidOf(o, fault.word))};
    return job;
}

} // namespace physvib
