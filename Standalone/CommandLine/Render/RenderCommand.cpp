// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib render`: reads and checks inputs, opens outputs, makes events, renders samples, and
// puts the files in place when all are written.
#include "Calls/CallOptions.h"
#include "CommandLine/Command.h"
#include "CommandLine/Render/RenderInputs.h"
#include "CommandLine/Render/RenderOutputs.h"
#include "Contacts/ContactCounts.h"
#include "Core/Units.h"
#include "Io/Disk/FileClash.h"
#include "Live/Session/ContactAudio.h"
#include "Live/Session/OfflineRender.h"
#include <algorithm>
#include <iostream>
#include <sstream>

namespace physvib {
namespace {

constexpr std::int64_t maxWavBytes = 4'000'000'000; // a little below the limit of a RIFF header

// The error of an event at or above half the sample rate, which would alias; or empty.
std::string aliasingError(int rateHz, const std::vector<CollisionEvent>& events, const std::string& source) {
    const double limitHz = 0.5 * rateHz;
    const auto highEvent =
        std::find_if(events.begin(), events.end(), [=](const auto& e) { return e.frequencyHz >= limitHz; });
    if (highEvent == events.end()) return {};
    std::ostringstream text;
    text << source << ": event " << highEvent - events.begin() + 1
         << ": column frequency_hz: expected less than half of --rate, " << limitHz << " Hz, found "
         << highEvent->frequencyHz;
    return text.str();
}

// Prints warnings about all that was lost or altered.
void printRenderLosses(const RenderStatus& status, const LoadedRender& job) {
    const auto& events = job.collisions.events;
    const auto afterEnd =
        std::count_if(events.begin(), events.end(), [&](const auto& e) { return e.timeNs >= job.endNs(); });
    warnIfAny(job.collisions.drops, "collisions lost because too many began in one physics step");
    warnIfAny(status.rejected, "events that could not be played");
    warnIfAny(status.late, "events played late");
    warnIfAny(status.withoutPart,
              "events of a part of the body that no actuator has, felt by their place on all");
    warnIfAny(status.stolen, "modes faded out early because too many different ones sounded at once");
    warnIfAny(status.nonFinite, "samples that were not finite and became silence");
    warnIfAny(status.guarded,
              "times an actuator was turned down, as it would have got nearly direct current");
    warnIfAny(static_cast<std::uint64_t>(afterEnd),
              "events that begin after the end of the render (see --seconds)");
    if (job.scene || job.clip) return;
    const std::string outsideText = outsideFieldWarning(events, job.field(), job.hasGuessedField());
    if (!outsideText.empty()) printMessage("warning: " + outsideText);
}

OfflineSettings makeSettings(const LoadedRender& job, const std::vector<RenderControl>& controls,
                             const RecordedContacts& contacts) {
    const RenderJob& o = job.options;
    const RendererSettings renderer{.sampleRateHz = o.sampleRateHz,
                                    .channels = job.channels(),
                                    .panner = job.panner(),
                                    .limiterEnabled = job.isLimited(),
                                    .ceilings = job.ceilings(),
                                    .instructions = o.instructions,
                                    .equalised = job.equalised(),
                                    .drives = job.coupling.drives.view(),
                                    .normalisesBlocks = o.limiting == Limiting::blocks};
    return {renderer, job.frames(), o.blockFrames, controls, contacts};
}

/// Renders the contact sound of the events, in one channel or two. Of the controls only a stop applies, and
/// with two channels a change of the field.
void renderContactSound(const LoadedRender& job, std::vector<RenderControl> controls,
                        RenderOutputs& outputs) {
    const RenderJob& o = job.options;
    const ContactSounds sounds{job.recordings, o.sampleRateHz};
    ContactAudioRender audio{o.sampleRateHz, job.frames(), o.blockFrames};
    audio.channels = o.contactSoundChannels;
    audio.field = job.panner();
    audio.levelDb = o.contactSoundDb;
    audio.recordings = {sounds.contacts(), true};
    renderContactAudio(job.collisions.events, std::move(controls), audio,
                       [&](const float* const* channels, int frames) {
                           return outputs.writeContactSound(channels, frames);
                       });
}

/// Renders the clip's samples, without collisions or controls.
RenderStatus renderClip(const LoadedRender& job, RenderOutputs& outputs) {
    const ClipEvents clip{job};
    return renderOffline(
        clip.events(), makeSettings(job, {}, {clip.contacts()}),
        [&](const float* const* channels, int frames) { return outputs.write(channels, frames); });
}

/// Renders the samples, and the onset markers if requested, in the same pass.
RenderStatus renderWithMarks(const LoadedRender& job, OfflineSettings settings, RenderOutputs& outputs) {
    const auto markedOnsets = job.options.marks();
    if (!markedOnsets)
        return renderOffline(job.collisions.events, settings, [&](const float* const* channels, int frames) {
            return outputs.write(channels, frames);
        });
    OnsetMarks marks{*markedOnsets};
    settings.marks = &marks;
    const auto status =
        renderOffline(job.collisions.events, settings, [&](const float* const* channels, int frames) {
            return outputs.write(channels, frames) && outputs.writeMarks(channels[job.channels()], frames);
        });
    outputs.setMarkSummary(marks);
    return status;
}

RenderStatus renderEvents(const LoadedRender& job, RenderOutputs& outputs) {
    SessionRecordings recordings{job.session ? job.session->log : SessionLog{}, job.sessionRecordings,
                                 job.options.sampleRateHz};
    const auto controls =
        recordings.mergedWith(job.session ? logControls(job.session->log, job.keepsLayouts(), job.channels())
                                          : std::vector<RenderControl>{});
    outputs.computeMotorCommands(controls);
    const RenderStatus status = renderWithMarks(
        job, makeSettings(job, controls, recordings.withClips(job.playedRecordings())), outputs);
    if (outputs.needsContactSound()) renderContactSound(job, controls, outputs);
    return status;
}

void printExplanation(const LoadedRender& job, const RenderStatus& status) {
    const PhantomPanner panner = job.panner();
    OutputFacts output;
    output.levelGain = fromDecibels(job.options.levelDb);
    output.rejected = status.rejected;
    output.panner = &panner;
    std::cout << describe(job.collisions.counts, &output);
}

std::string render(LoadedRender& job) {
    RenderOutputs outputs{job};
    if (auto error = outputs.open(); !error.empty()) return error;
    const auto warnings = makeEvents(job);
    if (!warnings) return warnings.error;
    if (auto error = aliasingError(job.options.sampleRateHz, job.collisions.events, job.source());
        !error.empty())
        return error;
    if (auto error = loadNamedRecordings(job, job.collisions.events, job.source()); !error.empty())
        return error;
    for (const std::string& note : recordingNotes(job.recordings)) printMessage(note);
    outputs.startZoom();
    const RenderStatus status = job.clip ? renderClip(job, outputs) : renderEvents(job, outputs);
    if (auto error = outputs.finish(); !error.empty()) return error;
    for (const std::string& line : warnings.value) printMessage("warning: " + line);
    for (const std::string& line : calibrationWarnings(job.options, job.layout))
        printMessage("warning: " + line);
    for (const std::string& line : levelNotes(job.actuators, job.options.sampleRateHz)) printMessage(line);
    if (!job.coupling.note.empty()) printMessage(job.coupling.note);
    printRenderLosses(status, job);
    outputs.summarise(std::cout);
    if (job.options.explains) printExplanation(job, status);
    return {};
}

/// Runs the render of the checked options. All files appear, or none. Returns an exit code.
int runRender(const RenderJob& options) {
    LoadedRender job{options, {}, {}, {}, {}};
    if (const int code = loadInputs(job); code != exitDone) return code;
    if (job.clip && !options.pad.empty())
        return reportExit(exitUsage,
                          "--pad: expected a scene, a session or events; a clip has samples alone");
    if (const std::string clash = fileClashError(options.writtenPaths(), job.namedInputs()); !clash.empty())
        return reportExit(exitUsage, clash);
    if (job.frames() > maxWavBytes / static_cast<std::int64_t>(sizeof(float)) / job.channels())
        return reportExit(exitUsage, "--seconds: too long; a WAV file holds at most 4 GB of samples");
    const std::string error = render(job);
    return error.empty() ? exitDone : reportExit(exitFailed, error);
}

} // namespace

Command renderCommand() {
    return makeCommand("render", "render a scene, an event list or a clip to files", declareRenderOptions,
                       [](const OptionTable& command, RenderJob& options) {
                           recordGivenOptions(command, options);
                           const std::string error = renderOptionsError(options);
                           return error.empty() ? runRender(options) : reportExit(exitUsage, error);
                       });
}

} // namespace physvib
