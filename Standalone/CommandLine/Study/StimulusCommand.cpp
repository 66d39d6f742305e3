// SPDX-License-Identifier: GPL-3.0-or-later
// From a stimulus to a WAV file and a picture.
#include "CommandLine/Study/StimulusCommand.h"
#include "CommandLine/Render/LayoutNamed.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Core/Limits.h"
#include "Files/WavSink.h"
#include "Pictures/RenderPicture.h"
#include "Session/StimulusRender.h"
#include <CLI/CLI.hpp>
#include <optional>

namespace physvib {
namespace {

void writeWav(const StimulusSound& sound, WavSink& sink) {
    std::vector<const float*> at;
    for (const auto& channel : sound.channels) at.push_back(channel.data());
    const auto frames = static_cast<int>(sound.channels.front().size());
    for (int done = 0; done < frames; done += limits::maxBlockFrames) {
        const int block = std::min(limits::maxBlockFrames, frames - done);
        sink.write(at.data(), block);
        for (auto& channel : at) channel += block;
    }
}

std::string pictureOf(const MadeStimulus& made, const StimulusOptions& o, const LayoutDescription& layout, const std::string& provenance) {
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
    return picturePng(picture);
}

int write(const MadeStimulus& made, const StimulusOptions& o, const LayoutDescription& layout) {
    const std::string provenance = provenanceLine({PHYSVIB_VERSION, {{"stimulus", made.title}, {"layout", o.layout}, {"level_g", numberText(o.levelG)}}});
    std::optional<WavSink> wav;
    if (!o.wavPath.empty()) {
        writeWav(made.sound, wav.emplace(o.wavPath, static_cast<int>(made.sound.channels.size()), made.sound.sampleRateHz, provenance));
        if (const auto& error = wav->complete(); !error.empty()) return leave(exitFailed, error);
    }
    if (const int code = writeStudyFiles({{o.picturePath, [&] { return pictureOf(made, o, layout, provenance); }}}); code != exitDone) return code;
    if (wav && !wav->finish().empty()) return leave(exitFailed, wav->error());
    std::cout << printable(made.title) << "  " << made.sound.channels.size() << (made.sound.channels.size() == 1 ? " channel, " : " channels, ")
              << fixedNumber(static_cast<double>(made.sound.channels.front().size()) / made.sound.sampleRateHz, 3) << " s\n";
    return exitDone;
}

int list(const StimulusOptions& o) {
    for (const auto& pattern : allPulsePatterns(o.enchanters)) std::cout << patternLabel(pattern) << '\n';
    return exitDone;
}

} // namespace

int runStimulus(const CLI::App& command, const StimulusOptions& o) {
    if (command.got_subcommand("list")) return list(o);
    const auto layout = layoutNamed(o.layout);
    if (!layout) return leave(exitFailed, layout.error);
    MadeStimulus made = makeStimulus(command, o, layout.value);
    if (!made.usage.empty()) return leave(exitUsage, "stimulus: " + made.usage);
    if (o.wavPath.empty() && o.picturePath.empty()) return leave(exitUsage, "stimulus: nothing to write; give --out or --picture");
    if (!made.note.empty()) tell(made.note);
    if (o.recording.empty() && made.error.empty()) {
        auto sound = renderStimulus(made.stimulus, layout.value, o.sampleRateHz);
        made.error = sound.error;
        made.sound = std::move(sound.value);
    }
    return made.error.empty() ? write(made, o, layout.value) : leave(exitFailed, made.error);
}

} // namespace physvib
