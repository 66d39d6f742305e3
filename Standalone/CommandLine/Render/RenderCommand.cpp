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
std::string tooHighFor(int rateHz, const std::vector<CollisionEvent>& events, const std::string& source) {
    const double limitHz = 0.5 * rateHz;
    const auto high =
        std::find_if(events.begin(), events.end(), [=](const auto& e) { return e.frequencyHz >= limitHz; });
    if (high == events.end()) return {};
    std::ostringstream text;
    text << source << ": event " << high - events.begin() + 1
         << ": column frequency_hz: expected less than half of --rate, " << limitHz << " Hz, found "
         << high->frequencyHz;
    return text.str();
}

// Prints warnings about all that was lost or altered.
void warnOfLosses(const RenderStatus& status, const LoadedRender& job) {
    const auto& events = job.made.events;
    const auto beyond =
        std::count_if(events.begin(), events.end(), [&](const auto& e) { return e.timeNs >= job.endNs(); });
    warnOf(job.made.drops, "collisions lost because too many began in one physics step");
    warnOf(status.rejected, "events that could not be played");
    warnOf(status.late, "events played late");
    warnOf(status.withoutPart,
           "events of a part of the body that no actuator has, felt by their place on all");
    warnOf(status.stolen, "modes faded out early because too many different ones sounded at once");
    warnOf(status.nonFinite, "samples that were not finite and became silence");
    warnOf(status.guarded, "times an actuator was turned down, as it would have got nearly direct current");
    warnOf(static_cast<std::uint64_t>(beyond),
           "events that begin after the end of the render (see --seconds)");
    if (job.scene || job.clip) return;
    const std::string outside = outsideWarning(events, job.field(), job.hasGuessedField());
    if (!outside.empty()) tell("warning: " + outside);
}

OfflineSettings settingsOf(const LoadedRender& job, const std::vector<RenderControl>& controls,
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
    ContactAudioRender heard{o.sampleRateHz, job.frames(), o.blockFrames};
    heard.ears = o.contactSoundEars;
    heard.field = job.panner();
    heard.levelDb = o.contactSoundDb;
    heard.recordings = {sounds.contacts(), true};
    renderContactAudio(
        job.made.events, std::move(controls), heard,
        [&](const float* const* channels, int frames) { return outputs.takeContactSound(channels, frames); });
}

/// Renders the clip's samples, without collisions or controls.
RenderStatus renderClip(const LoadedRender& job, RenderOutputs& outputs) {
    const ClipVoices voices{job};
    return renderOffline(
        voices.events(), settingsOf(job, {}, {voices.contacts()}),
        [&](const float* const* channels, int frames) { return outputs.take(channels, frames); });
}

/// Renders the samples, and the onset markers if requested, in the same pass.
RenderStatus renderMarked(const LoadedRender& job, OfflineSettings settings, RenderOutputs& outputs) {
    const auto which = job.options.marks();
    if (!which)
        return renderOffline(job.made.events, settings, [&](const float* const* channels, int frames) {
            return outputs.take(channels, frames);
        });
    OnsetMarks marks{*which};
    settings.marks = &marks;
    const auto status =
        renderOffline(job.made.events, settings, [&](const float* const* channels, int frames) {
            return outputs.take(channels, frames) && outputs.takeMarks(channels[job.channels()], frames);
        });
    outputs.tellMarks(marks);
    return status;
}

RenderStatus renderEvents(const LoadedRender& job, RenderOutputs& outputs) {
    SessionRecordings again{job.session ? job.session->log : SessionLog{}, job.sessionRecordings,
                            job.options.sampleRateHz};
    const auto controls =
        again.with(job.session ? controlsOf(job.session->log, job.keepsLayouts(), job.channels())
                               : std::vector<RenderControl>{});
    outputs.takeMotors(controls);
    const RenderStatus status =
        renderMarked(job, settingsOf(job, controls, again.beside(job.feltRecordings())), outputs);
    if (outputs.wantsContactSound()) renderContactSound(job, controls, outputs);
    return status;
}

void printExplanation(const LoadedRender& job, const RenderStatus& status) {
    const PhantomPanner panner = job.panner();
    OutputFacts output;
    output.levelGain = fromDecibels(job.options.levelDb);
    output.rejected = status.rejected;
    output.panner = &panner;
    std::cout << describe(job.made.counts, &output);
}

std::string render(LoadedRender& job) {
    RenderOutputs outputs{job};
    if (auto error = outputs.open(); !error.empty()) return error;
    const auto warnings = makeEvents(job);
    if (!warnings) return warnings.error;
    if (auto error = tooHighFor(job.options.sampleRateHz, job.made.events, job.source()); !error.empty())
        return error;
    if (auto error = takeRecordings(job, job.made.events, job.source()); !error.empty()) return error;
    for (const std::string& note : notesOf(job.recordings)) tell(note);
    outputs.begin();
    const RenderStatus status = job.clip ? renderClip(job, outputs) : renderEvents(job, outputs);
    if (auto error = outputs.finish(); !error.empty()) return error;
    for (const std::string& line : warnings.value) tell("warning: " + line);
    for (const std::string& line : calibrationWarnings(job.options, job.layout)) tell("warning: " + line);
    for (const std::string& line : levelNotes(job.actuators, job.options.sampleRateHz)) tell(line);
    if (!job.coupling.note.empty()) tell(job.coupling.note);
    warnOfLosses(status, job);
    outputs.summarise(std::cout);
    if (job.options.explains) printExplanation(job, status);
    return {};
}

/// Runs the render of the checked options. All files appear, or none. Returns an exit code.
int runRender(const RenderJob& options) {
    LoadedRender job{options, {}, {}, {}, {}};
    if (const int code = takeInputs(job); code != exitDone) return code;
    if (job.clip && !options.pad.empty())
        return leave(exitUsage, "--pad: expected a scene, a session or events; a clip has samples alone");
    if (const std::string clash = fileClash(options.writtenPaths(), job.namedInputs()); !clash.empty())
        return leave(exitUsage, clash);
    if (job.frames() > maxWavBytes / static_cast<std::int64_t>(sizeof(float)) / job.channels())
        return leave(exitUsage, "--seconds: too long; a WAV file holds at most 4 GB of samples");
    const std::string error = render(job);
    return error.empty() ? exitDone : leave(exitFailed, error);
}

} // namespace

Command renderCommand() {
    return commandOf("render", "render a scene, an event list or a clip to files", declareRenderOptions,
                     [](const OptionTable& command, RenderJob& options) {
                         noteGiven(command, options);
                         const std::string refusal = renderFault(options);
                         return refusal.empty() ? runRender(options) : leave(exitUsage, refusal);
                     });
}

} // namespace physvib
