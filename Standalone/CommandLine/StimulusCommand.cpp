// SPDX-License-Identifier: GPL-3.0-or-later
// From words to a stimulus, from there to a WAV file and a picture.
#include "CommandLine/StimulusCommand.h"
#include "CommandLine/LayoutNamed.h"
#include "CommandLine/StudyOutput.h"
#include "Core/Limits.h"
#include "Host/RenderPicture.h"
#include "Host/StimulusRender.h"
#include "Host/WavSink.h"
#include "Study/Stimulus.h"
#include <CLI/CLI.hpp>
#include <cmath>

namespace physvib {
namespace {

/// A stimulus on its way to a file; `usage` says what is wrong with the call, `error` with a file or a level.
struct Made {
    std::string usage, error, title;
    Stimulus stimulus; ///< empty events: a recording
    StimulusSound sound;
};

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

std::string makePattern(const StimulusOptions& o, const LayoutDescription& layout, Made& made) {
    const auto pattern = parsePatternLabel(o.pattern);
    const int enchanters = layout.geometry.count;
    if (!pattern) return "expected a pattern like ABA-250 (one to three enchanters, then milliseconds), found " + inQuotes(o.pattern);
    for (int k = 0; k < pattern->count; ++k)
        if (pattern->enchanters[static_cast<std::size_t>(k)] >= enchanters)
            return "expected enchanters among the " + std::to_string(enchanters) + " of the layout, found " + inQuotes(o.pattern);
    made.stimulus = patternStimulus(*pattern, enchanters, {o.frequencyHz, o.levelG}, o.gapSeconds);
    made.title = o.pattern;
    return {};
}

std::string makePhantom(const StimulusOptions& o, const LayoutDescription& layout, Made& made) {
    FieldPlace place;
    PanningLaw law;
    if (auto refusal = findPlace(o, place); !refusal.empty()) return refusal;
    if (!panningLawNamed(o.law, law)) return "--law: expected linear, log, log-outer or energy, found " + inQuotes(o.law);
    const PhantomPanner panner{layout.geometry, law, o.exponent, layout.geometry.extentWidthMetres, layout.geometry.extentHeightMetres};
    made.title = o.cell.empty() ? "phantom at " + o.at : "phantom " + o.cell + " of " + o.grid;
    made.stimulus = phantomStimulus(place, layout.geometry, law, o.exponent, {o.frequencyHz, o.levelG}, o.seconds);
    if (o.recording.empty()) return {};
    made.title = std::filesystem::path{o.recording}.filename().string();
    made.stimulus.events.clear();
    const auto recording = readWav(o.recording);
    if (!recording) {
        made.error = recording.error;
    } else if (recording.value.channels.size() != 1) {
        made.error = o.recording + ": expected one channel, found " + std::to_string(recording.value.channels.size());
    } else {
        auto placed = placeRecording(recording.value, place, o.levelG, panner, layout);
        made.error = placed.error;
        made.sound = std::move(placed.value);
    }
    return {};
}

std::string wavBytes(const StimulusSound& sound, const std::string& temporary, const std::string& comment, const std::string& name) {
    WavSink sink{temporary, static_cast<int>(sound.channels.size()), sound.sampleRateHz, comment, name};
    std::vector<const float*> at;
    for (const auto& channel : sound.channels) at.push_back(channel.data());
    const auto frames = static_cast<int>(sound.channels.front().size());
    for (int done = 0; done < frames; done += limits::maxBlockFrames) {
        const int block = std::min(limits::maxBlockFrames, frames - done);
        sink.write(at.data(), block);
        for (auto& channel : at) channel += block;
    }
    return sink.finish();
}

std::string pictureOf(const Made& made, const StimulusOptions& o, const LayoutDescription& layout, const std::string& provenance) {
    const auto frames = static_cast<std::int64_t>(made.sound.channels.front().size());
    const int channels = static_cast<int>(made.sound.channels.size());
    WaveformEnvelope whole{channels, 0, frames}, start{channels, 0, std::min<std::int64_t>(frames, made.sound.sampleRateHz / 10)};
    std::vector<const float*> at;
    for (const auto& channel : made.sound.channels) at.push_back(channel.data());
    whole.add(at.data(), static_cast<int>(frames));
    start.add(at.data(), static_cast<int>(frames));
    PictureInput picture;
    picture.title = made.title;
    picture.subtitle = "a stimulus";
    picture.fieldWidthMetres = layout.geometry.extentWidthMetres;
    picture.fieldHeightMetres = layout.geometry.extentHeightMetres;
    picture.events = made.stimulus.events;
    picture.layout = layout.geometry;
    for (const auto& enchanter : layout.enchanters) picture.labels.push_back(enchanter.label);
    picture.waveform = &whole;
    picture.zoom = &start;
    picture.sampleRateHz = made.sound.sampleRateHz;
    picture.durationSeconds = static_cast<double>(frames) / made.sound.sampleRateHz;
    picture.law = o.law + " law";
    picture.provenance = provenance;
    const juce::MemoryBlock png = picturePng(picture);
    return {static_cast<const char*>(png.getData()), png.getSize()};
}

int write(const Made& made, const StimulusOptions& o, const LayoutDescription& layout) {
    const std::string provenance = provenanceLine({PHYSVIB_VERSION, {{"stimulus", made.title}, {"layout", o.layout}, {"level_g", numberText(o.levelG)}}});
    if (!o.wavPath.empty()) {
        AtomicFile file{o.wavPath};
        if (!file.error().empty()) return leave(exitFailed, file.error());
        if (auto error = wavBytes(made.sound, file.temporaryPath().string(), provenance, o.wavPath); !error.empty()) return leave(exitFailed, error);
        if (const auto& error = file.commit(); !error.empty()) return leave(exitFailed, error);
    }
    if (const int code = writeStudyFiles({{o.picturePath, [&] { return pictureOf(made, o, layout, provenance); }}}); code != exitDone) return code;
    std::cout << printable(made.title) << "  " << made.sound.channels.size() << (made.sound.channels.size() == 1 ? " channel, " : " channels, ")
              << fixedNumber(static_cast<double>(made.sound.channels.front().size()) / made.sound.sampleRateHz, 3) << " s\n";
    return exitDone;
}

int list(const StimulusOptions& o) {
    for (const auto& pattern : allPulsePatterns(o.enchanters)) std::cout << patternLabel(pattern) << '\n';
    return exitDone;
}

void declarePlace(CLI::App& command, StimulusOptions& o) {
    command.add_option("--at", o.at, "place on the field: right and down, from 0 to 1")->type_name("X,Y");
    command.add_option("--grid", o.grid, "columns and rows of a grid, e.g. 7x5")->type_name("CxR");
    command.add_option("--cell", o.cell, "row and column in the grid, from 1, row 1 above")->type_name("r,c");
    command.add_option("--points", o.points, "the grid's points: its outer ones on the corners, or the middles of cells")
        ->check(CLI::IsMember({"corners", "middles"}))->capture_default_str();
    command.add_option("--law", o.law, "panning law: linear, log, log-outer, energy")->capture_default_str();
    command.add_option("--exponent", o.exponent, "exponent of the law")->check(CLI::Range(0.01, 100.0))->capture_default_str();
}

void declareCarrier(CLI::App& command, StimulusOptions& o) {
    command.add_option("--frequency", o.frequencyHz, "Hz")->check(CLI::Range(1.0, limits::maxFrequencyHz))->capture_default_str();
    command.add_option("--rate", o.sampleRateHz, "sample rate")->check(CLI::Range(limits::minSampleRateHz, limits::maxSampleRateHz))->capture_default_str();
}

} // namespace

void declareStimulus(CLI::App& command, StimulusOptions& o) {
    command.require_subcommand(1);
    CLI::App* const pattern = command.add_subcommand("pattern", "a spatiotemporal pattern of pulses");
    CLI::App* const phantom = command.add_subcommand("phantom", "a stationary phantom between the enchanters");
    CLI::App* const wav = command.add_subcommand("wav", "a recording as a phantom, at its own rate");
    CLI::App* const all = command.add_subcommand("list", "the labels of all patterns, one per line");
    pattern->add_option("pattern", o.pattern, "enchanters in the order of the pulses, and a pulse's ms")->required()->type_name("ABA-250");
    pattern->add_option("--gap", o.gapSeconds, "silence between pulses, s")->check(CLI::Range(0.0, 10.0))->capture_default_str();
    wav->add_option("recording", o.recording, "one channel")->required()->type_name("FILE.wav");
    phantom->add_option("--seconds", o.seconds, "length")->check(CLI::Range(0.001, 600.0))->capture_default_str();
    all->add_option("--enchanters", o.enchanters, "how many")->check(CLI::Range(1, 26))->capture_default_str();
    for (CLI::App* one : {pattern, phantom}) declareCarrier(*one, o);
    for (CLI::App* one : {phantom, wav}) declarePlace(*one, o);
    for (CLI::App* one : {pattern, phantom, wav}) {
        one->add_option("--layout", o.layout, "phone1..phone4, ring1..ring4 or a layout file")->capture_default_str();
        one->add_option("--level-g", o.levelG, "peak acceleration at gain 1, in g")->check(CLI::Range(1e-6, 1000.0))->capture_default_str();
        one->add_option("--out", o.wavPath, "32-bit float WAV, one channel per enchanter, 1 = its full scale")->type_name("FILE.wav");
        one->add_option("--picture", o.picturePath, "what each enchanter plays")->type_name("FILE.png");
    }
}

int runStimulus(const CLI::App& command, const StimulusOptions& o) {
    if (command.got_subcommand("list")) return list(o);
    const auto layout = layoutNamed(o.layout);
    if (!layout) return leave(exitFailed, layout.error);
    Made made;
    made.usage = command.got_subcommand("pattern") ? makePattern(o, layout.value, made) : makePhantom(o, layout.value, made);
    if (!made.usage.empty()) return leave(exitUsage, "stimulus: " + made.usage);
    if (o.wavPath.empty() && o.picturePath.empty()) return leave(exitUsage, "stimulus: nothing to write; give --out or --picture");
    if (o.recording.empty()) {
        auto sound = renderStimulus(made.stimulus, layout.value, o.sampleRateHz);
        made.error = sound.error;
        made.sound = std::move(sound.value);
    }
    return made.error.empty() ? write(made, o, layout.value) : leave(exitFailed, made.error);
}

} // namespace physvib
