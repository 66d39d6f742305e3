// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib stimulus`: renders a stimulus to a WAV file and a picture.
#include "Calls/CallOptions.h"
#include "CommandLine/Command.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Core/Samples.h"
#include "Io/Disk/FileClash.h"
#include "Io/Wav/WavSink.h"
#include "Lab/Study/Stimulus.h"
#include "Live/Recordings/ReadRecording.h"
#include "Live/Session/SessionRender.h"
#include "Pictures/RenderPicture.h"
#include "Scene/LayoutFile.h"
#include <optional>
#include <vector>

namespace physvib {
namespace {

/// A rendered stimulus.
struct MadeStimulus {
    std::string title;
    std::vector<CollisionEvent> events; ///< empty for a recording
    StimulusSound sound;
};

std::string titleOf(const StimulusJob& job, const StimulusOptions& o) {
    const auto* const phantom = std::get_if<PhantomJob>(&job.what);
    if (phantom == nullptr) return o.pattern.label;
    if (!phantom->recording.empty()) return leafOf(phantom->recording);
    return o.cell.empty() ? "phantom at " + o.at : "phantom " + o.cell + " of " + o.grid;
}

/// The recording of a phantom as samples at its own rate.
Result<StimulusSound> placed(const PhantomJob& phantom, double levelG, const LayoutDescription& layout) {
    auto recording = readRecording(phantom.recording);
    if (!recording) return recording;
    if (recording.value.channels.size() != 1)
        return Failure{phantom.recording + ": expected one channel, found " +
                       std::to_string(recording.value.channels.size())};
    if (const auto note =
            takeSlowPart(recording.value, phantom.recording, peakOf(recording.value.channels.front()));
        !note.empty())
        tell(note);
    const EnchanterLayout& places = layout.geometry;
    return placeRecording(
        recording.value, phantom.place(), levelG,
        {places, phantom.law, phantom.exponent, places.extentWidthMetres, places.extentHeightMetres}, layout);
}

Result<StimulusSound> soundOf(const StimulusJob& job, const StimulusOptions& o,
                              const LayoutDescription& layout, std::vector<CollisionEvent>& events) {
    if (const auto* const phantom = std::get_if<PhantomJob>(&job.what);
        phantom != nullptr && !phantom->recording.empty())
        return placed(*phantom, job.levelG, layout);
    auto stimulus = makeStimulus(job, layout);
    if (!stimulus) return Failure{stimulus.error};
    events = stimulus.value.events;
    return renderStimulus(stimulus.value, layout, o.sampleRateHz);
}

/// Where its channels begin.
std::vector<const float*> channelsOf(const StimulusSound& sound) {
    std::vector<const float*> at;
    for (const auto& channel : sound.channels) at.push_back(channel.data());
    return at;
}

std::string pictureOf(const MadeStimulus& made, const StimulusOptions& o, const LayoutDescription& layout,
                      const std::string& provenance) {
    const auto frames = static_cast<std::int64_t>(made.sound.channels.front().size());
    const int channels = static_cast<int>(made.sound.channels.size());
    WaveformEnvelope whole{channels, 0, frames},
        start{channels, 0, std::min<std::int64_t>(frames, made.sound.sampleRateHz / 10)};
    const auto at = channelsOf(made.sound);
    whole.add(at.data(), static_cast<int>(frames));
    start.add(at.data(), static_cast<int>(frames));
    PictureInput picture;
    picture.title = made.title;
    picture.subtitle = "a stimulus";
    picture.fieldWidthMetres = layout.geometry.extentWidthMetres;
    picture.fieldHeightMetres = layout.geometry.extentHeightMetres;
    picture.events = made.events;
    picture.layout = layout.geometry;
    for (const auto& enchanter : layout.enchanters) picture.labels.push_back(enchanter.label);
    picture.waveform = &whole;
    picture.zoom = &start;
    picture.sampleRateHz = made.sound.sampleRateHz;
    picture.durationSeconds = static_cast<double>(frames) / made.sound.sampleRateHz;
    picture.law = std::string{nameOf(o.phantom.law)} + " law";
    picture.provenance = provenance;
    return picturePng(picture);
}

int write(const MadeStimulus& made, const StimulusOptions& o, const LayoutDescription& layout) {
    const std::string provenance = provenanceLine(
        {PHYSVIB_VERSION,
         {{"stimulus", made.title}, {"layout", o.job.layout}, {"level_g", numberText(o.job.levelG)}}});
    std::optional<WavSink> wav;
    if (!o.wavPath.empty()) {
        wav.emplace(o.wavPath, static_cast<int>(made.sound.channels.size()), made.sound.sampleRateHz,
                    provenance)
            .write(channelsOf(made.sound).data(), static_cast<int>(made.sound.channels.front().size()));
        if (const auto& error = wav->complete(); !error.empty()) return leave(exitFailed, error);
    }
    if (const int code =
            writeStudyFiles({{o.picturePath, [&] { return pictureOf(made, o, layout, provenance); }}});
        code != exitDone)
        return code;
    if (wav && !wav->finish().empty()) return leave(exitFailed, wav->error());
    std::cout << printable(made.title) << "  " << counted(made.sound.channels.size(), "channel") << ", "
              << fixedNumber(
                     static_cast<double>(made.sound.channels.front().size()) / made.sound.sampleRateHz, 3)
              << " s\n";
    return exitDone;
}

int list(const StimulusOptions& o) {
    for (const auto& pattern : allPulsePatterns(o.enchanters)) std::cout << patternLabel(pattern) << '\n';
    return exitDone;
}

int runStimulus(const OptionTable& command, const StimulusOptions& o) {
    if (command.isCalled("list")) return list(o);
    const auto layout = layoutNamed(o.job.layout);
    if (!layout) return leave(exitFailed, layout.error);
    const auto job = readStimulus(command, o);
    if (!job) return leave(exitUsage, "stimulus: " + job.error);
    if (const auto fault = layoutFault(job.value, layout.value); !fault.empty())
        return leave(exitUsage, "stimulus: " + fault);
    if (o.wavPath.empty() && o.picturePath.empty())
        return leave(exitUsage, "stimulus: nothing to write; give --out or --picture");
    MadeStimulus made{titleOf(job.value, o), {}, {}};
    auto sound = soundOf(job.value, o, layout.value, made.events);
    if (!sound) return leave(exitFailed, sound.error);
    made.sound = std::move(sound.value);
    return write(made, o, layout.value);
}

} // namespace

Command stimulusCommand() {
    return commandOf("stimulus", "a single stimulus of a study", declareStimulus, runStimulus);
}

} // namespace physvib
