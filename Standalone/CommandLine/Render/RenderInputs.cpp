// SPDX-License-Identifier: GPL-3.0-or-later
// Loads the inputs of a render, simulates its scene, and shapes each collision's event by the options.
#include "CommandLine/Render/RenderInputs.h"
#include "Formats/StrikeClip.h"
#include "Live/Recordings/ReadRecording.h"
#include "Live/Session/SessionRender.h"
#include "Scene/ActuatorFile.h"
#include "Scene/EventsCsv.h"
#include "Scene/SceneFile.h"
#include <functional>

namespace physvib {
namespace {

/// Loads the layout of the options, else `ownLayout`, and the data of its actuators; or one error line.
std::string chooseLayout(LoadedRender& job, std::optional<LayoutDescription> ownLayout) {
    const bool usesOwnLayout = ownLayout && !job.options.isGiven("--layout");
    auto layout = usesOwnLayout ? Result{std::move(*ownLayout)} : resolveLayout(job.options.layout);
    if (layout) layout = calibratedLayout(job.options, std::move(layout.value));
    if (!layout) return layout.error;
    job.layout = std::move(layout.value);
    if (auto error = fixedLevelError(job); !error.empty()) return error;
    auto actuators = chooseActuators(job.options, job.layout);
    job.actuators = std::move(actuators.value);
    return actuators.error;
}

std::string readInputs(LoadedRender& job) {
    if (auto error = chooseLayout(job, job.session ? std::optional{job.session->layout} : std::nullopt);
        !error.empty())
        return error;
    if (!job.options.coupling.empty()) {
        if (job.session)
            return "--coupling: expected a scene or events; a saved session may change its layout and play "
                   "recordings";
        auto coupling = chooseCoupling(job.options.coupling, job.layout);
        if (!coupling) return coupling.error;
        job.coupling = std::move(coupling.value);
    }
    if (job.scene) return {};
    auto events = loadEventsCsv(job.options.fromEvents);
    if (!events) return events.error;
    job.collisions.events = std::move(events.value.events);
    job.listField = events.value.field;
    job.listNames = std::move(events.value.names);
    return {};
}

/// Simulates the events of the scene or session; one error line if the simulation takes too long.
Result<SceneEvents> simulateEvents(const LoadedRender& job) {
    SimulationTimeLimit timeLimit{job.options.timeoutSeconds};
    auto simulated = job.session
                         ? sessionEvents(*job.session, job.endNs(), std::ref(timeLimit))
                         : simulateScene(*job.scene, job.settings(), job.endNs(), std::ref(timeLimit));
    if (auto error = timeLimit.error(); !error.empty()) return Failure{job.options.scene + ": " + error};
    return simulated;
}

} // namespace

int loadInputs(LoadedRender& job) {
    const std::string& name = job.options.scene;
    if (findClipFormat(name)) return loadClipInto(job);
    if (!name.empty()) {
        const bool isSession = isJsonPath(name) && fileKind(name) == FileKind::session;
        if (const int code = isSession ? loadSessionInto(job) : loadSceneInto(job); code != exitDone)
            return code;
    }
    const std::string error = readInputs(job);
    return error.empty() ? exitDone : reportExit(exitFailed, error);
}

Result<std::vector<std::string>> makeEvents(LoadedRender& job) {
    if (job.scene) {
        auto simulated = simulateEvents(job);
        if (!simulated) return Failure{simulated.error};
        job.collisions = std::move(simulated.value);
    }
    auto warnings = remapWarnings(job.shaping().remap, job.collisions.events, job.layout, job.options);
    EventShaper{job.shaping()}.shape(job.collisions.events);
    return warnings;
}

namespace {

bool hasPlaces(const Clip& clip) {
    return std::ranges::all_of(clip.channels,
                               [](const ClipChannel& channel) { return channel.place.has_value(); });
}

LayoutDescription makeClipLayout(const Clip& clip) {
    ActuatorLayout geometry{
        clip.extentWidthMetres, clip.extentHeightMetres, static_cast<int>(clip.channels.size()), {}};
    for (std::size_t j = 0; j < clip.channels.size(); ++j) geometry.places[j] = *clip.channels[j].place;
    return describeLayout("clip", geometry);
}

/// Converts the place to metres of the job's field.
ActuatorPlace channelPlace(const LoadedRender& job, std::size_t channel) {
    const Clip& clip = *job.clip;
    const ActuatorLayout& layout = job.layout.geometry;
    const auto toField = [&](double x, double y) {
        return ActuatorPlace{x * job.fieldWidthMetres(), y * job.fieldHeightMetres()};
    };
    if (hasPlaces(clip))
        return toField(clip.channels[channel].place->xMetres / clip.extentWidthMetres,
                       clip.channels[channel].place->yMetres / clip.extentHeightMetres);
    if (static_cast<int>(clip.channels.size()) != layout.count) return toField(0.5, 0.5);
    return toField(layout.places[channel].xMetres / layout.extentWidthMetres,
                   layout.places[channel].yMetres / layout.extentHeightMetres);
}

std::string channelCountError(const LoadedRender& job) {
    const Clip& clip = *job.clip;
    const auto channels = clip.channels.size();
    if (!hasPlaces(clip) && channels != 1 && static_cast<int>(channels) != job.layout.geometry.count)
        return "expected one channel, places, or as many channels as the layout has actuators, " +
               std::to_string(job.layout.geometry.count) + ", found " + std::to_string(channels);
    return soundError({job.options.sampleRateHz, static_cast<std::int64_t>(channels),
                       static_cast<std::int64_t>(clip.seconds() * job.options.sampleRateHz)});
}

} // namespace

ClipEvents::ClipEvents(const LoadedRender& job)
    : sound_{clipSound(*job.clip, job.options.sampleRateHz)} {
    if (const std::string note = removeSlowPart(sound_, job.options.scene); !note.empty()) printMessage(note);
    for (std::size_t j = 0; j < sound_.channels.size(); ++j) {
        const ActuatorPlace place = channelPlace(job, j);
        const SoundNumber sound = soundOfClip(static_cast<int>(j));
        events_.push_back({0, clipFrequencyHz, 1.0, job.gain(), place.xMetres, place.yMetres, 0, {}});
        events_.back().sound = sound;
        contacts_.push_back({clipFrequencyHz, sound_.channels[j], sound});
    }
}

Result<FrequencyScale> findFrequencyScale(const RenderJob& options) {
    if (options.actuator == "none" || options.actuator == "layout") return FrequencyScale{};
    const auto profile = findActuator(options.actuator);
    if (!profile) return Failure{"--actuator: " + profile.error};
    return profile.value.band ? FrequencyScale{profile.value.band->lowHz, profile.value.band->highHz}
                              : FrequencyScale{};
}

int loadClipInto(LoadedRender& job) {
    const RenderJob& o = job.options;
    if (const char* option = o.firstGiven({"--set", "--seed", "--steps-per-second", "--location", "--timing",
                                           "--method", "--sound", "--perceived-level", "--remap",
                                           "--contact-sound", "--marker", "--events", "--coupling"}))
        return reportExit(exitUsage, std::string{option} + ": a clip has no collisions");
    const auto scale = findFrequencyScale(o);
    if (!scale) return reportExit(exitFailed, scale.error);
    auto clip = loadClip(o.scene, *findClipFormat(o.scene), scale.value);
    if (!clip) return reportExit(exitFailed, clip.error);
    if (!clip.value.omissions.empty()) printMessage("warning: " + o.scene + ": " + clip.value.omissions);
    job.clip = std::move(clip.value);
    if (auto error =
            chooseLayout(job, hasPlaces(*job.clip) ? std::optional{makeClipLayout(*job.clip)} : std::nullopt);
        !error.empty())
        return reportExit(exitFailed, error);
    const std::string error = channelCountError(job);
    return error.empty() ? exitDone : reportExit(exitFailed, o.scene + ": " + error);
}

} // namespace physvib
