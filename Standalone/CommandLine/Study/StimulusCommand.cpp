// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib stimulus`: renders a stimulus to a WAV file and a picture.
#include "Calls/CallOptions.h"
#include "CommandLine/Command.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Core/Samples.h"
#include "Io/Disk/FileClash.h"
#include "Io/Wav/WavSink.h"
#include "Lab/Study/StimulusJob.h"
#include "Live/Recordings/ReadRecording.h"
#include "Live/Session/SessionRender.h"
#include "Pictures/RenderPicture.h"
#include "Scene/LayoutFile.h"
#include <optional>
#include <vector>

namespace physvib {
namespace {

struct RenderedStimulus {
    std::string title;
    std::vector<CollisionEvent> events; ///< empty for a recording
    StimulusSound sound;
};

std::string stimulusTitle(const StimulusJob& job, const StimulusOptions& o) {
    const auto* const phantom = std::get_if<PhantomJob>(&job.stimulus);
    if (phantom == nullptr) return o.pattern.label;
    if (!phantom->recording.empty()) return fileNameOf(phantom->recording);
    return o.cell.empty() ? "phantom at " + o.place : "phantom " + o.cell + " of " + o.grid;
}

/// The recording of a phantom as samples at its own rate.
Result<StimulusSound> placeSound(const PhantomJob& phantom, double levelG, const LayoutDescription& layout) {
    auto recording = readRecording(phantom.recording);
    if (!recording) return recording;
    if (recording.value.channels.size() != 1)
        return Failure{phantom.recording + ": expected one channel, found " +
                       std::to_string(recording.value.channels.size())};
    if (const auto note =
            removeSlowPart(recording.value, phantom.recording, peakOf(recording.value.channels.front()));
        !note.empty())
        printMessage(note);
    const ActuatorLayout& geometry = layout.geometry;
    return placeRecording(
        recording.value, phantom.place(), levelG,
        {geometry, phantom.law, phantom.exponent, geometry.extentWidthMetres, geometry.extentHeightMetres},
        layout);
}

Result<StimulusSound> makeSound(const StimulusJob& job, const StimulusOptions& o,
                                const LayoutDescription& layout, std::vector<CollisionEvent>& events) {
    if (const auto* const phantom = std::get_if<PhantomJob>(&job.stimulus);
        phantom != nullptr && !phantom->recording.empty())
        return placeSound(*phantom, job.levelG, layout);
    auto stimulus = makeStimulus(job, layout);
    if (!stimulus) return Failure{stimulus.error};
    events = stimulus.value.events;
    return renderStimulus(stimulus.value, layout, o.sampleRateHz);
}

/// Pointers to the first sample of each channel; valid as long as the sound.
std::vector<const float*> toPointers(const StimulusSound& sound) {
    std::vector<const float*> pointers;
    for (const auto& channel : sound.channels) pointers.push_back(channel.data());
    return pointers;
}

std::string drawStimulus(const RenderedStimulus& result, const StimulusOptions& o,
                         const LayoutDescription& layout, const std::string& provenance) {
    const auto frames = static_cast<std::int64_t>(result.sound.channels.front().size());
    const int channels = static_cast<int>(result.sound.channels.size());
    WaveformEnvelope overview{channels, 0, frames},
        zoom{channels, 0, std::min<std::int64_t>(frames, result.sound.sampleRateHz / 10)};
    const auto samples = toPointers(result.sound);
    overview.add(samples.data(), static_cast<int>(frames));
    zoom.add(samples.data(), static_cast<int>(frames));
    PictureInput picture;
    picture.title = result.title;
    picture.subtitle = "a stimulus";
    picture.fieldWidthMetres = layout.geometry.extentWidthMetres;
    picture.fieldHeightMetres = layout.geometry.extentHeightMetres;
    picture.events = result.events;
    picture.layout = layout.geometry;
    for (const auto& actuator : layout.actuators) picture.labels.push_back(actuator.label);
    picture.waveform = &overview;
    picture.zoom = &zoom;
    picture.sampleRateHz = result.sound.sampleRateHz;
    picture.durationSeconds = static_cast<double>(frames) / result.sound.sampleRateHz;
    picture.law = std::string{nameOf(o.phantom.law)} + " law";
    picture.provenance = provenance;
    return picturePng(picture);
}

int writeOutputs(const RenderedStimulus& result, const StimulusOptions& o, const LayoutDescription& layout) {
    const std::string provenance = provenanceLine(
        {PHYSVIB_VERSION,
         {{"stimulus", result.title}, {"layout", o.job.layout}, {"level_g", numberText(o.job.levelG)}}});
    std::optional<WavSink> wav;
    if (!o.wavPath.empty()) {
        wav.emplace(o.wavPath, static_cast<int>(result.sound.channels.size()), result.sound.sampleRateHz,
                    provenance)
            .write(toPointers(result.sound).data(), static_cast<int>(result.sound.channels.front().size()));
        if (const auto& error = wav->complete(); !error.empty()) return reportExit(exitFailed, error);
    }
    if (const int code =
            writeStudyFiles({{o.picturePath, [&] { return drawStimulus(result, o, layout, provenance); }}});
        code != exitDone)
        return code;
    if (wav && !wav->finish().empty()) return reportExit(exitFailed, wav->error());
    std::cout << printable(result.title) << "  " << plural(result.sound.channels.size(), "channel") << ", "
              << fixedNumber(
                     static_cast<double>(result.sound.channels.front().size()) / result.sound.sampleRateHz, 3)
              << " s\n";
    return exitDone;
}

int listPatterns(const StimulusOptions& o) {
    for (const auto& pattern : allPulsePatterns(o.enchanters)) std::cout << patternLabel(pattern) << '\n';
    return exitDone;
}

int runStimulus(const OptionTable& command, const StimulusOptions& o) {
    if (command.isCalled("list")) return listPatterns(o);
    const auto layout = resolveLayout(o.job.layout);
    if (!layout) return reportExit(exitFailed, layout.error);
    const auto job = readStimulus(command, o);
    if (!job) return reportExit(exitUsage, "stimulus: " + job.error);
    if (const auto error = layoutError(job.value, layout.value); !error.empty())
        return reportExit(exitUsage, "stimulus: " + error);
    if (o.wavPath.empty() && o.picturePath.empty())
        return reportExit(exitUsage, "stimulus: nothing to write; give --out or --picture");
    RenderedStimulus result{stimulusTitle(job.value, o), {}, {}};
    auto sound = makeSound(job.value, o, layout.value, result.events);
    if (!sound) return reportExit(exitFailed, sound.error);
    result.sound = std::move(sound.value);
    return writeOutputs(result, o, layout.value);
}

} // namespace

Command stimulusCommand() {
    return makeCommand("stimulus", "a single stimulus of a study", declareStimulus, runStimulus);
}

} // namespace physvib
