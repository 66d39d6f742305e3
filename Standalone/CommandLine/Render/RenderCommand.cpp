// SPDX-License-Identifier: GPL-3.0-or-later
// The way of a render: inputs are read and checked, outputs opened, events made or taken, samples rendered, and only
// when everything is written do the files take their places.
#include "CommandLine/Render/RenderCommand.h"
#include "CommandLine/Render/RenderJob.h"
#include "CommandLine/Render/RenderOutputs.h"
#include "Files/Disk/FileClash.h"
#include "Files/Disk/FileKind.h"
#include "Files/Text/NumberText.h"
#include "Session/HeardContacts.h"
#include "Session/OfflineRender.h"
#include "Session/SessionRender.h"
#include <algorithm>
#include <functional>
#include <iostream>
#include <sstream>

namespace physvib {

namespace {

constexpr std::int64_t maxWavBytes = 4'000'000'000; // a little less than a RIFF header can say

// Sines above half the sample rate would come out as other sines.
std::string tooHighFor(int rateHz, const std::vector<CollisionEvent>& events, const std::string& source) {
    const double limitHz = 0.5 * rateHz;
    const auto high = std::find_if(events.begin(), events.end(), [=](const auto& e) { return e.frequencyHz >= limitHz; });
    if (high == events.end()) return {};
    std::ostringstream text;
    text << source << ": event " << high - events.begin() + 1 << ": column frequency_hz: expected less than half of --rate, "
         << limitHz << " Hz, found " << high->frequencyHz;
    return text.str();
}

// What was lost or altered must not go unseen.
void warn(const RenderStatus& status, const RenderJob& job) {
    const auto say = [](std::uint64_t count, const char* what) {
        if (count > 0) std::cerr << "physvib: warning: " << what << ": " << count << '\n';
    };
    const auto& events = job.made.events;
    const auto beyond = std::count_if(events.begin(), events.end(), [&](const auto& e) { return e.timeNs >= job.endNs(); });
    say(job.made.drops, "collisions lost because too many began in one physics step");
    say(status.rejected, "events that could not be played");
    say(status.late, "events played late");
    say(status.stolen, "modes faded out early because too many different ones sounded at once");
    say(status.nonFinite, "samples that were not finite and became silence");
    say(static_cast<std::uint64_t>(beyond), "events that begin after the end of the render (see --seconds)");
}

std::string readInputs(RenderJob& job) {
    if (job.session && !job.options.given.contains("--layout")) {
        job.layout = describeLayout("session", job.session->panner.layout());
    } else {
        auto layout = layoutNamed(job.options.layout);
        if (!layout) return layout.error;
        job.layout = std::move(layout.value);
    }
    if (auto fault = fixedLevelFault(job); !fault.empty()) return fault;
    auto actuators = chooseActuators(job.options, job.layout);
    if (!actuators) return actuators.error;
    job.actuators = std::move(actuators.value);
    if (!job.options.coupling.empty()) {
        if (job.session) return "--coupling: expected a scene or events; a saved session may change its layout and play recordings";
        auto coupling = chooseCoupling(job.options.coupling, job.layout);
        if (!coupling) return coupling.error;
        job.coupling = std::move(coupling.value);
    }
    if (job.scene) return {};
    auto events = loadEventsCsv(job.options.fromEvents);
    if (!events) return events.error;
    job.made.events = std::move(events.value);
    return {};
}

OfflineSettings settingsOf(const RenderJob& job, const std::vector<RenderControl>& controls, const ContactSounds& sounds) {
    const RenderOptions& o = job.options;
    const RendererSettings renderer{.sampleRateHz = o.sampleRateHz,
                                    .channels = job.channels(),
                                    .panner = job.panner(),
                                    .limiterEnabled = job.isLimited(),
                                    .ceilings = job.ceilings(),
                                    .equalised = job.equalised(),
                                    .drives = job.coupling.drives.view()};
    return {renderer, job.frames(), o.blockFrames, controls, sounds.contacts()};
}

/// Of the scene or session; one line if it is simulated too slowly.
Result<SceneEvents> eventsOf(const RenderJob& job) {
    Patience patience{job.options.patienceSeconds};
    auto made = job.session ? sessionEvents(*job.session, job.endNs(), std::ref(patience)) : runScene(*job.scene, job.run(), job.endNs(), std::ref(patience));
    if (auto fault = patience.fault(); !fault.empty()) return Failure{job.options.scene + ": " + fault};
    return made;
}

/// The same events once more, in one channel; controls of the enchanters say nothing here, but that all shall stop.
void renderContactSound(const RenderJob& job, std::vector<RenderControl> controls, RenderOutputs& outputs) {
    const ContactSounds sounds{job.recordings, job.options.sampleRateHz};
    std::erase_if(controls, [](const RenderControl& control) { return control.kind != RenderControl::Kind::stopAll; });
    renderOffline(job.made.events, {HeardContacts::settingsAt(job.options.sampleRateHz), job.frames(), job.options.blockFrames, controls, sounds.contacts(), true},
                  [&](const float* const* channels, int frames) { return outputs.takeContactSound(channels[0], frames); });
}

std::string render(RenderJob& job) {
    RenderOutputs outputs{job};
    if (auto error = outputs.open(); !error.empty()) return error;
    if (job.scene) {
        auto made = eventsOf(job);
        if (!made) return made.error;
        job.made = std::move(made.value);
    }
    const auto warnings = remapWarnings(job.shaping().remap, job.made.events, job.layout, job.options);
    std::ranges::transform(job.made.events, job.made.events.begin(), EventShaper{job.shaping()});
    const auto& source = job.scene ? job.scene->name : job.options.fromEvents;
    if (auto error = tooHighFor(job.options.sampleRateHz, job.made.events, source); !error.empty()) return error;
    if (auto error = takeRecordings(job, job.made.events, source); !error.empty()) return error;
    const ContactSounds sounds{job.feltRecordings(), job.options.sampleRateHz};
    outputs.begin();
    const SessionRecordings again{job.session ? job.session->log : SessionLog{}, job.sessionRecordings, job.options.sampleRateHz};
    const auto controls = again.with(job.session ? controlsOf(job.session->log, job.keepsLayouts(), job.channels()) : std::vector<RenderControl>{});
    const auto take = [&](const float* const* channels, int frames) { return outputs.take(channels, frames); };
    const RenderStatus status = renderOffline(job.made.events, settingsOf(job, controls, sounds), take);
    if (!job.options.contactSound.empty()) renderContactSound(job, controls, outputs);
    if (auto error = outputs.finish(); !error.empty()) return error;
    for (const std::string& line : warnings) tell("warning: " + line);
    for (const std::string& line : levelNotes(job.actuators, job.options.sampleRateHz)) tell(line);
    if (!job.coupling.note.empty()) tell(job.coupling.note);
    warn(status, job);
    outputs.summarise(std::cout);
    return {};
}

} // namespace

int runRender(const RenderOptions& options) {
    RenderJob job{options, {}, {}, {}, {}};
    if (!options.scene.empty()) {
        const bool isSession = isJsonPath(options.scene) && fileKind(options.scene) == FileKind::session;
        if (const int code = isSession ? takeSession(job) : takeScene(job); code != exitDone) return code;
    }
    if (const std::string error = readInputs(job); !error.empty()) return leave(exitFailed, error);
    if (const std::string clash = fileClash(options.writtenPaths(), job.namedInputs()); !clash.empty()) return leave(exitUsage, clash);
    if (job.frames() > maxWavBytes / static_cast<std::int64_t>(sizeof(float)) / job.channels())
        return leave(exitUsage, "--seconds: too long; a WAV file holds at most 4 GB of samples");
    const std::string error = render(job);
    return error.empty() ? exitDone : leave(exitFailed, error);
}

} // namespace physvib
