// SPDX-License-Identifier: GPL-3.0-or-later
// Declares the options of `physvib render` and `physvib stimulus`: names, ranges and help texts; converts
// parsed stimulus options to a job; and checks the files that a call names.
#include "Calls/CallOptions.h"
#include "Core/EventShaping.h"
#include "Formats/ClipFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/StimulusJob.h"
#include "Live/Devices/AudioOutput.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace physvib {

static_assert(defaultContactSoundDb == defaultContactDb, "as on a device");

void declareSceneOptions(OptionTable& command, RenderJob& o) {
    command.add("scene", o.scene,
                "a built-in scene (see `physvib scenes`), SCENE.json, or a CLIP" + nameList(clipEndings) +
                    ", or (render, export) a saved SESSION.json, or (play) a SOUND.wav, .flac, .ogg");
    addSettings(command, o.settings);
    command.add("--seconds", o.seconds, "length").in(0.001, 86400.0, " s");
    command.add("--seed", o.seed, "seed of the scene").in(0u, 4294967295u);
    command.add("--layout", o.layout, rangeList(layoutPresetNames) + ", study1, dualsense or a layout file");
    addField(command, o.field);
    addLaw(command, o.law);
    command.add("--exponent", o.exponent, "exponent of the law").in(0.01, 100.0);
    command.addOneOf<Limiting>("--limiter", o.limiting,
                               {{"on", Limiting::on}, {"off", Limiting::off}, {"blocks", Limiting::blocks}},
                               "on, off, or each block by itself, as in the thesis");
    command.add("--steps-per-second", o.stepsPerSecond, "physics steps per second")
        .in(Simulation::minStepsPerSecond, Simulation::maxStepsPerSecond, " steps/s");
    command.addOneOf<ImpactLocation>(
        "--location", o.location,
        {{"contact", ImpactLocation::contact}, {"fixture", ImpactLocation::fixture}},
        "place of a hit: contact, or centre of the fixture");
    command.addOneOf<ImpactTiming>(
        "--timing", o.timing, {{"onset", ImpactTiming::onset}, {"release", ImpactTiming::release}},
        "a hit is felt when its contact begins (onset) or ends (release, at most 50 ms later)");
    addMethod(command, o);
    command.addOneOf<bool>("--fixed-level", o.fixesSum, {{"sum", true}, {"each", false}},
                           "of a fixed amplitude: the peak of all that sound together (sum), or of each hit, "
                           "as in the thesis (each)");
    addSounds(command, o.sounds,
              "for SV and --contact-sound: the recorded contact of a material, or HZ=FILE.wav of all of that "
              "frequency; FILE may be synthetic-SEED; may be repeated");
    command.addOneOf<bool>(
        "--sound-match", o.matchesStrength, {{"peak", false}, {"rms", true}},
        "level of recordings: their peak is the mode's (peak), or their strength over 0.25 s is (rms)");
    command.add("--level-db", o.levelDb, "all hits so much stronger or weaker")
        .in(-limits::maxLevelDb, limits::maxLevelDb, " dB");
    command
        .add("--gamma", o.gamma,
             "cut each decay where its envelope falls to this share, as Eq. 5.5 does with 0.1 (0: it rings "
             "out, without a click); recordings (SV) are played whole")
        .in(0.0, EventShaping::maxTruncation);
    command.addSwitch("--perceived-level", o.isWeighted,
                      "weight hits by how strong their frequency is felt, by at most 6 dB (on or off)");
    command
        .add("--contact-sound-db", o.contactSoundDb,
             "its level: that of a hit at full scale, in dB of full scale")
        .in(minContactDb, maxContactDb, " dB");
    command.addOneOf<MarkedOnsets>(
        "--marker-of", o.markedOnsets,
        {{"all", MarkedOnsets::all}, {"hits", MarkedOnsets::hits}, {"messages", MarkedOnsets::messages}},
        "what --marker marks: all onsets, hits (no grains, no messages), or messages");
    command.add(
        "--actuator", o.actuator,
        "none, layout (those it names), or one for all: a name (see physvib actuators) or a profile's file");
    command.addSwitch("--equalise", o.isEqualised,
                      "with an actuator: make it flat within its band (on or off)");
    command.addSwitch("--remap", o.isRemapped,
                      "with an actuator: move all frequencies into its band, in their order (on or off)");
    command
        .add("--coupling", o.coupling,
             "measured coupling of the layout's actuators, made up for with at most 3 dB more drive (render)")
        .as("FILE.json");
}

void declareRenderOptions(OptionTable& command, RenderJob& o) {
    declareSceneOptions(command, o);
    command.add("--from-events", o.fromEvents, "render this event list instead of a scene").as("EVENTS.csv");
    command.add("--out", o.wavPath, "32-bit float WAV, one channel per actuator").outputFile("FILE.wav");
    command
        .add("--pad", o.pad,
             "with --out MOTORS.csv: what the motors of that game controller would get instead of samples; a "
             "profile (pad-generic, pad-xbox, pad-dualshock) or its file")
        .as("PROFILE");
    command.add("--events", o.eventsPath, "the collisions as an event list").outputFile("FILE.csv");
    command.add("--picture", o.picturePath, "world, waveforms and event marks").outputFileNamed("FILE.png");
    command
        .add("--movie", o.moviePath,
             "world, impacts and channels in time: .webp; with the program ffmpeg also .gif, and .mp4 with "
             "audio")
        .outputFile("FILE.webp");
    command.add("--pattern", o.patternPath, "when a motor that is only on or off would be on, per channel")
        .outputFile("FILE.csv");
    command.add("--explain", o.explains,
                "count the scene's contacts, and say why nothing or not everything is felt");
    command.add("--threshold", o.threshold, "of the pattern, in full scale").in(0.0, 1.0);
    command
        .add("--interface-volts", o.interfaceVolts,
             "with an actuator: scale the WAV so that full scale becomes its drive limit on an interface of "
             "this peak voltage")
        .in(0.001, 1000.0, " V");
    command
        .add("--contact-sound", o.contactSound,
             "what is heard of each hit, for headphones or loudspeakers, in sync with --out")
        .outputFile("FILE.wav");
    command.add("--contact-sound-channels", o.contactSoundChannels, "2: left and right, by place").in(1, 2);
    command.add("--marker", o.marker, "a pulse at the sample of each onset: one channel, in sync with --out")
        .outputFile("FILE.wav");
    command.add("--rate", o.sampleRateHz, "sample rate")
        .in(limits::minSampleRateHz, limits::maxSampleRateHz, " Hz");
    command.add("--block", o.blockFrames, "frames per block; changes nothing but --limiter blocks")
        .in(1, limits::maxBlockFrames, " frames");
    command.addOneOf<InstructionSet>(
        "--instructions", o.instructions,
        {{"best", InstructionSet::best}, {"scalar", InstructionSet::scalar}},
        "best: the vectors of this processor, with the same bytes on all; scalar: double precision");
    command
        .add("--patience", o.timeoutSeconds,
             "time-out: processor time, beyond its own length, that a world may take to simulate")
        .in(0.0, 1e7, " s");
}

void recordGivenOptions(const OptionTable& command, RenderJob& o) {
    for (const Option& option : command.options)
        if (!option.arguments.empty()) o.givenOptions.insert(option.spellings.front());
}

Option& addLaw(OptionTable& command, PanningLaw& law) {
    const auto read = [&law](const std::string& word) {
        return panningLawNamed(word, law)
                   ? std::string{}
                   : "expected " + nameList(panningLawNames, " or ") + ", found " + inQuotes(word);
    };
    return command.addRead(stimulusOptions::law, std::string{nameOf(law)}, read,
                           "panning law: " + nameList(panningLawNames));
}

Option& addSounds(OptionTable& command, RecordedSounds& sounds, std::string helpText) {
    const WordsReader read = [&sounds](const std::vector<std::string>& words) -> std::string {
        for (const std::string& word : words) {
            const auto equals = word.find('=');
            const auto hz = parseNumber<double>(std::string_view{word}.substr(0, equals));
            if (equals == std::string::npos || equals == 0 || equals + 1 == word.size() ||
                (hz && !(*hz > 0.0)))
                return "expected MATERIAL=FILE.wav, a material and its recorded contact, or HZ=FILE.wav, its "
                       "frequency";
            const RecordedSound sound{hz ? "" : word.substr(0, equals), hz.value_or(0.0),
                                      word.substr(equals + 1)};
            const auto hasSameName = [&](const RecordedSound& other) { return other.name() == sound.name(); };
            if (std::ranges::any_of(sounds, hasSameName))
                return "expected one recording of " + sound.name() + ", found another";
            sounds.push_back(sound);
        }
        return {};
    };
    return command.addRow("--sound", read, std::move(helpText)).as("MATERIAL=FILE.wav").single();
}

Option& addField(OptionTable& command, FieldSize& field) {
    const auto read = [&field](const std::string& word) {
        const auto found = parseField(word);
        if (found) field = *found;
        return found ? std::string{} : std::string{expectedFieldText} + inQuotes(word);
    };
    return command
        .addRead("--field", {}, read,
                 "metres that x and y span (scene: its field; events: as they say, or the layout's extent)")
        .as("W,H");
}

Option& addSettings(OptionTable& command, SceneSettings& settings) {
    const WordsReader read = [&settings](const std::vector<std::string>& words) {
        for (const std::string& word : words) {
            const auto equals = word.find('=');
            if (equals == 0 || equals == std::string::npos) return "expected NAME=VALUE";
            settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
        }
        return "";
    };
    return command.addRow("--set", read, "a variable of the scene; may be repeated")
        .as("NAME=VALUE")
        .single();
}

Option& addMethod(OptionTable& command, RenderJob& job) {
    const auto read = [&job](const std::string& word) {
        job.playsRecordings = word == "SV";
        return job.playsRecordings || parseRenderingMethod(word, job.method)
                   ? std::string{}
                   : "expected a name from AV-FV-DRV to AF-FF-DRF, or SV, found " + inQuotes(word);
    };
    return command.addRead("--method", job.methodName(), read,
                           "A{V,F}-F{V,F}-DR{V,F}: amplitude, frequency, decay varied by physics or fixed; "
                           "or SV, recorded contacts");
}

namespace {

namespace names = stimulusOptions;
namespace ranges = parameterRanges;

bool parsePair(const std::string& text, char separator, double& first, double& second) {
    const std::size_t split = text.find(separator);
    if (split == std::string::npos) return false;
    const auto a = parseNumber<double>(std::string_view{text}.substr(0, split)),
               b = parseNumber<double>(std::string_view{text}.substr(split + 1));
    if (a) first = *a;
    if (b) second = *b;
    return a && b;
}

/// The place in "0.25,0.5"; for invalid text a place outside the field, which jobError() refuses.
FieldPlace parsePlace(const std::string& text) {
    FieldPlace place;
    return parsePair(text, ',', place.x, place.y) ? place : FieldPlace{-1.0, -1.0};
}

GridPlace gridPlace(const StimulusOptions& o) {
    double columns = 0.0, rows = 0.0;
    const auto lineCount = [](double n) {
        return n >= 1.0 && n <= static_cast<double>(maxGridLines) && n == std::floor(n) ? static_cast<int>(n)
                                                                                        : 0;
    };
    if (!parsePair(o.grid, 'x', columns, rows)) columns = rows = 0.0;
    return {{lineCount(columns), lineCount(rows),
             o.points == "middles" ? PhantomGrid::Points::middles : PhantomGrid::Points::corners},
            parseGridCell(o.cell).value_or(GridCell{})};
}

/// The call's text for the option named `word`.
const std::string& findArgument(const StimulusOptions& o, std::string_view word) {
    return word == names::place       ? o.place
           : word == names::grid      ? o.grid
           : word == names::cell      ? o.cell
           : word == names::frequency ? o.frequency
                                      : o.pattern.label;
}

void declarePlace(OptionTable& command, StimulusOptions& o) {
    command.add(names::place, o.place, "place on the field: right and down, from 0 to 1").as("X,Y");
    command.add(names::grid, o.grid, "columns and rows of a grid, e.g. 7x5").as("CxR");
    command.add(names::cell, o.cell, "row and column in the grid, from 1, row 1 above").as("r,c");
    command
        .add(names::points, o.points,
             "the grid's points: its outer ones on the corners, or the middles of cells")
        .oneOf({"corners", "middles"});
    addLaw(command, o.phantom.law);
    command.add(names::exponent, o.phantom.exponent, "exponent of the law")
        .in(ranges::exponent.min, ranges::exponent.max);
}

void declareCarrier(OptionTable& command, StimulusOptions& o) {
    command.add(names::frequency, o.frequency, "Hz, or resonance: that of the layout's actuators");
    command.add("--rate", o.sampleRateHz, "sample rate").in(limits::minSampleRateHz, limits::maxSampleRateHz);
}

} // namespace

void declareStimulus(OptionTable& command, StimulusOptions& o) {
    OptionTable& pattern = command.addCommand("pattern", "a spatiotemporal pattern of pulses");
    OptionTable& phantom = command.addCommand("phantom", "a stationary phantom between the actuators");
    OptionTable& wav =
        command.addCommand("wav", "a recording or a haptic file as a phantom, at its own rate");
    wav.alias = "clip";
    OptionTable& list = command.addCommand("list", "the labels of all patterns, one per line");
    pattern.add("pattern", o.pattern.label, "actuators in the order of the pulses, and a pulse's ms")
        .required()
        .as("ABA-250");
    pattern.add(names::gap, o.pattern.gapSeconds, "silence between pulses, s")
        .in(ranges::gapSeconds.min, ranges::gapSeconds.max);
    wav.add("recording", o.phantom.recording, "one channel").required().as("FILE.wav");
    phantom.add(names::seconds, o.phantom.seconds, "length").in(ranges::seconds.min, ranges::seconds.max);
    phantom.add(names::decay, o.phantom.decayPerSecond, "decay of the amplitude, 1/s; 0: a burst")
        .in(ranges::decayPerSecond.min, ranges::decayPerSecond.max);
    phantom
        .add(
            names::levelMeasure, o.levelMeasure,
            "--level-g is the peak, or that of a burst of the same rms over the length, of a burst of 1 s of "
            "the same energy, or of a burst whose rms is that behind the hand-arm weighting of ISO 5349-1")
        .oneOf({levelMeasureNames.begin(), levelMeasureNames.end()});
    list.add("--enchanters", o.enchanters, "how many").in(1, 26);
    for (OptionTable* const subcommand : {&pattern, &phantom}) declareCarrier(*subcommand, o);
    for (OptionTable* const subcommand : {&phantom, &wav}) declarePlace(*subcommand, o);
    for (OptionTable* const subcommand : {&pattern, &phantom, &wav}) {
        subcommand->add(names::layout, o.job.layout,
                        rangeList(layoutPresetNames) + ", study1 or a layout file");
        subcommand->add(names::levelG, o.job.levelG, "peak acceleration at gain 1, in g")
            .in(ranges::levelG.min, ranges::levelG.max);
        subcommand->add("--out", o.wavPath, "32-bit float WAV, one channel per actuator, 1 = its full scale")
            .outputFile("FILE.wav");
        subcommand->add("--picture", o.picturePath, "what each actuator plays").outputFileNamed("FILE.png");
    }
}

Result<StimulusJob> readStimulus(const OptionTable& command, const StimulusOptions& o) {
    StimulusJob job = o.job;
    job.frequencyHz = parseNumber<double>(o.frequency).value_or(0.0);
    if (o.frequency == names::resonance) job.frequencyHz.reset();
    job.stimulus = o.pattern;
    if (!command.isCalled("pattern")) {
        if (o.place.empty() == o.cell.empty())
            return Failure{"give either --at X,Y or --grid CxR with --cell r,c"};
        auto& phantom = job.stimulus.emplace<PhantomJob>(o.phantom);
        phantom.levelMeasure = static_cast<LevelMeasure>(
            std::ranges::find(levelMeasureNames, o.levelMeasure) - levelMeasureNames.begin());
        if (o.place.empty())
            phantom.target = gridPlace(o);
        else
            phantom.target = parsePlace(o.place);
    }
    const JobError error = jobError(job);
    if (error) return Failure{error.text() + ", found " + inQuotes(findArgument(o, error.option))};
    return job;
}

namespace {

struct CallFiles {
    std::vector<std::string> outputs, inputs;
};

void collectFiles(const OptionTable& table, CallFiles& files) {
    for (const Option& option : table.options)
        for (const std::string& value : option.arguments) {
            if (option.isOutputFile)
                files.outputs.push_back(value);
            else
                files.inputs.insert(files.inputs.end(),
                                    {value, value.substr(value.find('=') + 1)}); // of MATERIAL=FILE
        }
    for (const OptionTable* const command : table.calls) collectFiles(*command, files);
}

void collectOutputOptions(const OptionTable& table, std::set<std::string, std::less<>>& words) {
    for (const Option& option : table.options)
        if (option.isOutputFile) words.insert(option.spellings.begin(), option.spellings.end());
    for (const OptionTable& command : table.commands) collectOutputOptions(command, words);
}

/// Every spelling of every output-file option of the commands that a call may use.
std::set<std::string, std::less<>> outputOptionNames() {
    OptionTable calls{"physvib", {}};
    RenderJob render;
    StimulusOptions stimulus;
    declareRenderOptions(calls.addCommand("render", {}), render);
    declareStimulus(calls.addCommand("stimulus", {}), stimulus);
    std::set<std::string, std::less<>> words;
    collectOutputOptions(calls, words);
    return words;
}

} // namespace

std::string outputOptionError(std::string_view call) {
    static const auto words = outputOptionNames();
    while (!call.empty()) {
        const std::string_view word = call.substr(0, call.find(' '));
        call.remove_prefix(std::min(word.size() + 1, call.size()));
        if (words.contains(word.substr(0, word.find('='))))
            return "expected no file to be written, found " + std::string(word);
    }
    return {};
}

std::string callLinkError(const OptionTable& app, const std::string& folder) {
    CallFiles files;
    collectFiles(app, files);
    for (const std::string& path : files.inputs)
        if (auto error = linkError(folder, path); !error.empty()) return error;
    return {};
}

std::string callFileClash(const OptionTable& app) {
    CallFiles files;
    collectFiles(app, files);
    return fileClashError(files.outputs, files.inputs);
}

} // namespace physvib
