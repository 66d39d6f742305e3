// SPDX-License-Identifier: GPL-3.0-or-later
// Events by the door of `render`, panned and drawn as curves, then as bytes.
#include "CommandLine/Render/ExportCommand.h"
#include "CommandLine/Render/ClipInput.h"
#include "CommandLine/Render/RenderInputs.h"
#include "CommandLine/Study/CallFiles.h"
#include "Files/ActuatorFile.h"
#include "Files/Disk/AtomicFile.h"
#include "Files/Disk/FileClash.h"
#include "Formats/ClipFile.h"
#include "Formats/ClipLimits.h"
#include "Formats/StrikeClip.h"
#include "Wire/BoardSteps.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <list>
#include <set>

namespace physvib {
namespace {

constexpr double leastError = 1e-5, mostError = 0.1;

/// The panner at an event's time: a session may have changed its layout.
StrikeGains gainsOf(const RenderJob& job) {
    return [&job, panner = job.panner(), next = std::size_t{0}](const CollisionEvent& event, PhantomPanner::Gains& gains) mutable {
        while (job.keepsLayouts() && next < job.session->log.panners.size() && job.session->log.panners[next].timeNs <= event.timeNs) panner = job.session->log.panners[next++].panner;
        gains = {};
        panner.gainsAt(event.x, event.y, event.course.spread, gains);
    };
}

/// Other formats do not move what sounds: its steps, as the board's.
std::vector<CollisionEvent> stillStrikes(const std::vector<CollisionEvent>& events) {
    std::vector<CollisionEvent> still;
    for (const CollisionEvent& event : events) {
        if (event.course.travelNs == 0) still.push_back(event);
        else
            for (BoardSteps steps{event}; !steps.isOver();) still.push_back(steps.take());
    }
    std::ranges::stable_sort(still, {}, &CollisionEvent::timeNs);
    return still;
}

/// What is known of an enchanter's actuator; nothing, if it has none.
Result<ClipDevice> deviceOf(const RenderJob& job, const EnchanterDescription& enchanter) {
    const ClipDevice device{0.0, 0.0, 0.0, enchanter.fullScaleG};
    const std::string& asked = job.options.actuator;
    const std::string& name = asked == "none" || asked == "layout" ? enchanter.actuator : asked;
    if (name == "none") return device;
    const auto profile = findActuator(name);
    if (!profile) return Failure{job.options.layout + ": enchanter " + enchanter.label + ": " + profile.error};
    const FrequencyBand band = profile.value.bandOrNone();
    return ClipDevice{band.lowHz, band.highHz, profile.value.resonanceHz.value_or(0.0), enchanter.fullScaleG};
}

Result<Clip> struckClip(RenderJob& job, double error) {
    if (const std::size_t hits = job.made.events.size(); hits > limits::maxClipStrikes)
        return Failure{job.source() + ": expected at most " + std::to_string(limits::maxClipStrikes) + " hits, found " + std::to_string(hits)};
    Clip clip = clipOfStrikes(stillStrikes(job.made.events), {error, static_cast<std::size_t>(job.channels()), gainsOf(job)});
    clip.title = std::filesystem::path{job.source()}.filename().string();
    clip.extentWidthMetres = job.layout.geometry.extentWidthMetres;
    clip.extentHeightMetres = job.layout.geometry.extentHeightMetres;
    for (std::size_t j = 0; j < std::min(clip.channels.size(), job.layout.enchanters.size()); ++j) {
        const auto device = deviceOf(job, job.layout.enchanters[j]);
        if (!device) return Failure{device.error};
        clip.channels[j].label = job.layout.enchanters[j].label;
        clip.channels[j].place = job.layout.geometry.places[j];
        clip.channels[j].device = device.value;
    }
    if (auto fault = clipFault(clip); !fault.empty()) return Failure{job.source() + ": " + fault};
    return clip;
}

/// One file, or, of a format with one channel, one for each that has something to say: NAME-A.haptic, NAME-B.haptic...
struct Part {
    std::string path;
    Clip clip;
};

std::vector<Part> partsOf(const Clip& clip, const std::string& to, ClipFormat format) {
    if (!isMono(format) || clip.channels.size() == 1) return {{to, clip}};
    std::vector<Part> parts;
    const std::filesystem::path path{to};
    for (std::size_t j = 0; j < clip.channels.size(); ++j) {
        Clip one{clip.title, 0.0, 0.0, {clip.channels[j]}};
        if (!(one.seconds() > 0.0)) continue;
        std::string label = clip.channels[j].label.empty() ? std::to_string(j + 1) : clip.channels[j].label;
        std::ranges::replace_if(label, [](char c) { return c == '/' || static_cast<unsigned char>(c) < 0x20; }, '_');
        parts.push_back({(path.parent_path() / (path.stem().string() + "-" + label + path.extension().string())).string(), std::move(one)});
    }
    return parts;
}

/// By what the channel's actuator plays, if that is known.
FrequencyScale scaleOf(const Clip& clip, const FrequencyScale& usual) {
    const ClipDevice& device = clip.channels.front().device;
    return device.highHz > device.lowHz ? FrequencyScale{device.lowHz, device.highHz} : usual;
}

std::string count(std::size_t number, const std::string& what) { return std::to_string(number) + " " + what + (number == 1 ? "" : "s"); }

std::string summary(const Part& part, std::size_t bytes) {
    return part.path + "  " + count(part.clip.channels.size(), "channel") + ", " + fixedNumber(part.clip.seconds(), 2) + " s, " + count(part.clip.points(), "keyframe") + ", " +
           fixedNumber(static_cast<double>(bytes) * 1e-3, 1) + " kB\n";
}

std::string write(const std::vector<Part>& parts, ClipFormat format, const FrequencyScale& usual) {
    std::list<AtomicFile> files;
    std::string told;
    for (const Part& part : parts) {
        const auto bytes = clipBytes(part.clip, format, scaleOf(part.clip, usual));
        if (!bytes) return part.path + ": " + bytes.error;
        if (const std::string& error = files.emplace_back(part.path).error(); !error.empty()) return error;
        if (const std::string& error = files.back().write(bytes.value); !error.empty()) return error;
        told += summary(part, bytes.value.size());
    }
    for (AtomicFile& file : files)
        if (const std::string& error = file.commit(); !error.empty()) return error;
    std::cout << told;
    return {};
}

void tellLosses(const RenderJob& job, const std::vector<Part>& parts, ClipFormat format, const FrequencyScale& usual) {
    std::set<std::string> told;
    for (const Part& part : parts)
        for (const std::string& loss : clipLosses(part.clip, format, scaleOf(part.clip, usual)))
            if (told.insert(loss).second) tell("warning: " + loss);
    if (parts.size() > 1) tell("warning: a file for each enchanter; for one file of all hits: --layout phone1");
    if (job.session && !job.session->log.channels.empty()) tell("warning: gains, mutes and stops of the session are not carried: hits are as they were struck");
    if (job.made.drops > 0) tell("warning: collisions lost because too many began in one physics step: " + std::to_string(job.made.drops));
}

/// Words of the call that say nothing here.
std::string refusalOf(const RenderOptions& o) {
    if (o.scene.empty()) return "export: give a scene, a saved session, EVENTS.csv or a clip";
    for (const char* other : {"--sound", "--sound-match", "--coupling", "--contact-sound-db", "--limiter", "--equalise"})
        if (o.given.contains(other)) return std::string{other} + ": says how something is played, not what it is: expected with render or play";
    return o.playsRecordings() ? "--method SV: recordings are no waves to be exported" : "";
}

/// Of scene, session or list: what lies within --seconds, if that is given.
std::string takeEvents(RenderJob& job, std::vector<std::string>& warnings) {
    if (!job.sessionRecordings.sets.empty()) return job.options.scene + ": the session plays recordings, which are no waves to be exported; expected --method AV-FV-DRV, for modes";
    if (job.session && !job.session->log.clips.empty()) return job.options.scene + ": the session plays clips, which are exported by themselves";
    auto made = makeEvents(job);
    if (!made) return made.error;
    warnings = std::move(made.value);
    if (job.scene || job.options.given.contains("--seconds")) std::erase_if(job.made.events, [&](const CollisionEvent& e) { return e.timeNs >= job.endNs(); });
    return {};
}

} // namespace

void declareExport(CLI::App& command, ExportOptions& o) {
    declareSceneOptions(command, o.input);
    command.add_option("--to", o.to, "the file; its ending says the format: .hjif, .hmpg (MPEG), .haptic (Meta), .ahap (Apple)")->required()->type_name("FILE")->check(writtenFile);
    command.add_option("--error", o.error, "how far lines may be from each hit's exponential, of its strength")->check(CLI::Range(leastError, mostError))->capture_default_str();
}

int runExport(const CLI::App& command, ExportOptions& options) {
    RenderOptions& o = options.input;
    noteGiven(command, o);
    if (const std::string refusal = refusalOf(o); !refusal.empty()) return leave(exitUsage, refusal);
    const auto format = clipFormatOf(options.to);
    if (!format) return leave(exitUsage, "--to: expected a name that ends in .hjif, .hmpg, .haptic or .ahap, found " + inQuotes(options.to));
    if (o.scene.ends_with(".csv")) o.fromEvents.swap(o.scene);
    o.equalise = "off"; // of the player's own actuators
    if (const std::string refusal = checkSceneOptions(o); !refusal.empty()) return leave(exitUsage, refusal);
    RenderJob job{o, {}, {}, {}, {}};
    if (const int code = takeInputs(job); code != exitDone) return code;
    const auto usual = frequencyScaleOf(o);
    if (!usual) return leave(exitFailed, usual.error);
    std::vector<std::string> warnings;
    if (const std::string error = job.clip ? std::string{} : takeEvents(job, warnings); !error.empty()) return leave(exitFailed, error);
    const Result<Clip> clip = job.clip ? Result<Clip>{*job.clip} : struckClip(job, options.error);
    if (!clip) return leave(exitFailed, clip.error);
    const std::vector<Part> parts = partsOf(clip.value, options.to, *format);
    std::vector<std::string> outputs, inputs = job.namedInputs();
    for (const Part& part : parts) outputs.push_back(part.path);
    for (const std::string& path : {o.scene, o.fromEvents, o.layout, o.actuator}) inputs.push_back(path);
    if (const std::string clash = fileClash(outputs, inputs); !clash.empty()) return leave(exitUsage, clash);
    if (const std::string error = write(parts, *format, usual.value); !error.empty()) return leave(exitFailed, error);
    for (const std::string& line : warnings) tell("warning: " + line);
    tellLosses(job, parts, *format, usual.value);
    return exitDone;
}

} // namespace physvib
