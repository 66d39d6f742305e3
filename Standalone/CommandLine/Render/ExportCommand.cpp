// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib export`: loads events like `render`, and writes their curves as a haptic file.
#include "Calls/CallOptions.h"
#include "CommandLine/Command.h"
#include "CommandLine/Render/RenderInputs.h"
#include "Io/Disk/FileClash.h"
#include "Live/Recordings/HitExport.h"
#include <algorithm>
#include <string>
#include <vector>

namespace physvib {
namespace {

struct ExportOptions {
    RenderJob input;  ///< what is exported, and its layout and panning
    std::string path; ///< its extension selects the format
    double maxDeviation = 0.004;
};

constexpr double smallestDeviation = 1e-5, largestDeviation = 0.1;

/// Gains of an event by the panner at its time, because a session may have changed its layout.
EventGains eventGains(const LoadedRender& job) {
    return [&job, panner = job.panner(), next = std::size_t{0}](const CollisionEvent& event,
                                                                PhantomPanner::Gains& gains) mutable {
        while (job.keepsLayouts() && next < job.session->log.panners.size() &&
               job.session->log.panners[next].timeNs <= event.timeNs)
            panner = job.session->log.panners[next++].panner;
        gains = {};
        panner.gainsAt(event, gains);
    };
}

HitExport toHits(const LoadedRender& job) {
    const std::string& actuator = job.options.actuator;
    const bool isDefault = actuator == "none" || actuator == "layout";
    return {job.source(), fileNameOf(job.source()), job.collisions.events,
            job.layout,   job.options.layout,       isDefault ? std::string{} : actuator};
}

Result<Clip> makeClip(const LoadedRender& job, double maxDeviation) {
    if (job.clip) return *job.clip;
    return makeHitClip(toHits(job),
                       {maxDeviation, static_cast<std::size_t>(job.channels()), eventGains(job)});
}

void printLosses(const LoadedRender& job, const std::vector<ClipPart>& parts, ClipFormat format,
                 const FrequencyScale& scale) {
    for (const std::string& loss : listLosses(parts, format, scale)) printMessage("warning: " + loss);
    if (parts.size() > 1)
        printMessage("warning: a file for each actuator; for one file of all hits: --layout phone1");
    if (job.session && !job.session->log.channels.empty())
        printMessage(
            "warning: gains, mutes and stops of the session are not carried: hits are as they were struck");
    warnIfAny(job.collisions.drops, "collisions lost because too many began in one physics step");
}

/// The error of options that have no effect on an export; or empty.
std::string exportOptionsError(const RenderJob& o) {
    if (o.scene.empty()) return "export: give a scene, a saved session, EVENTS.csv or a clip";
    if (const char* option = o.firstGiven(
            {"--sound", "--sound-match", "--coupling", "--contact-sound-db", "--limiter", "--equalise"}))
        return std::string{option} +
               ": says how something is played, not what it is: expected with render or play";
    return o.playsRecordings ? "--method SV: recordings are no waves to be exported" : "";
}

/// Makes the events of scene, session or list, within --seconds if given. Empty, or one error line.
std::string loadEvents(LoadedRender& job, std::vector<std::string>& warnings) {
    if (!job.sessionRecordings.sets.empty())
        return job.options.scene + ": the session plays recordings, which are no waves to be exported; "
                                   "expected --method AV-FV-DRV, for modes";
    if (job.session && !job.session->log.clips.empty())
        return job.options.scene + ": the session plays clips, which are exported by themselves";
    auto newWarnings = makeEvents(job);
    if (!newWarnings) return newWarnings.error;
    warnings = std::move(newWarnings.value);
    if (job.scene || job.options.isGiven("--seconds"))
        std::erase_if(job.collisions.events,
                      [&](const CollisionEvent& e) { return e.timeNs >= job.endNs(); });
    return {};
}

void declareExport(OptionTable& command, ExportOptions& o) {
    declareSceneOptions(command, o.input);
    std::vector<std::string> formats;
    for (const ClipFormatInfo& format : clipFormats)
        formats.push_back(std::string{format.ending} + " (" + std::string{format.owner} + ")");
    command.add("--to", o.path, "the file; its ending says the format: " + nameList(formats))
        .required()
        .outputFile("FILE");
    command
        .add("--error", o.maxDeviation, "how far lines may be from each hit's exponential, of its strength")
        .in(smallestDeviation, largestDeviation);
}

int runExport(const OptionTable& command, ExportOptions& options) {
    RenderJob& o = options.input;
    recordGivenOptions(command, o);
    if (const std::string error = exportOptionsError(o); !error.empty()) return reportExit(exitUsage, error);
    const auto format = findClipFormat(options.path);
    if (!format) return reportExit(exitUsage, "--to: " + fileExtensionError(options.path, writableEndings));
    if (o.scene.ends_with(".csv")) o.fromEvents.swap(o.scene);
    o.isEqualised = false; // the playing device equalises its own actuators
    if (const std::string error = sceneOptionsError(o); !error.empty()) return reportExit(exitUsage, error);
    LoadedRender job{o, {}, {}, {}, {}};
    if (const int code = loadInputs(job); code != exitDone) return code;
    const auto scale = findFrequencyScale(o);
    if (!scale) return reportExit(exitFailed, scale.error);
    std::vector<std::string> warnings;
    if (const std::string error = job.clip ? std::string{} : loadEvents(job, warnings); !error.empty())
        return reportExit(exitFailed, error);
    const Result<Clip> clip = makeClip(job, options.maxDeviation);
    if (!clip) return reportExit(exitFailed, clip.error);
    const std::vector<ClipPart> parts = splitClip(clip.value, options.path, *format);
    std::vector<std::string> outputs, inputs = job.namedInputs();
    for (const ClipPart& part : parts) outputs.push_back(part.path);
    for (const std::string& path : {o.scene, o.fromEvents, o.layout, o.actuator}) inputs.push_back(path);
    if (const std::string clash = fileClashError(outputs, inputs); !clash.empty())
        return reportExit(exitUsage, clash);
    const Result<std::string> written = writeParts(parts, *format, scale.value);
    if (!written) return reportExit(exitFailed, written.error);
    std::cout << written.value;
    for (const std::string& line : warnings) printMessage("warning: " + line);
    printLosses(job, parts, *format, scale.value);
    return exitDone;
}

} // namespace

Command exportCommand() {
    return makeCommand("export", "a scene, a session, EVENTS.csv or a clip as a haptic file of others",
                       declareExport, runExport);
}

} // namespace physvib
