// SPDX-License-Identifier: MIT
// Converts hits to clip channels, panned as they were played; each channel's device data come from its
// actuator's profile.
#include "Live/Recordings/HitExport.h"
#include "Formats/Clip.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Wav/WavSink.h"
#include "Live/Session/OfflineRender.h"
#include "Scene/ActuatorFile.h"
#include "Wire/BoardPath.h"
#include <filesystem>
#include <list>

namespace physvib {
namespace {

constexpr double maxWavBytes = 500e6; // the file is written while the user waits for a drag to start

/// Replaces each moving event by a series of stationary ones, because clips of other programs cannot move.
std::vector<CollisionEvent> stationaryEvents(std::span<const CollisionEvent> events) {
    std::vector<CollisionEvent> stationary;
    for (const CollisionEvent& event : events) {
        if (event.course.travelNs == 0)
            stationary.push_back(event);
        else
            for (BoardSteps steps{event}; !steps.isOver();) stationary.push_back(steps.next());
    }
    std::ranges::stable_sort(stationary, {}, &CollisionEvent::timeNs);
    return stationary;
}

/// Data of an actuator's profile; without one ("none"), only its full scale.
Result<ClipDevice> makeDevice(const HitExport& hits, const ActuatorDescription& actuator) {
    const ClipDevice device{0.0, 0.0, 0.0, actuator.fullScaleG};
    const std::string& name = hits.actuator.empty() ? actuator.actuator : hits.actuator;
    if (name == "none") return device;
    const auto profile = findActuator(name);
    if (!profile) return Failure{hits.layoutName + ": actuator " + actuator.label + ": " + profile.error};
    const FrequencyBand band = profile.value.bandOrUnknown();
    return ClipDevice{band.lowHz, band.highHz, profile.value.resonanceHz.value_or(0.0), actuator.fullScaleG};
}

/// The band of the channel's actuator, if known.
FrequencyScale channelScale(const Clip& clip, const FrequencyScale& defaultScale) {
    const ClipDevice& device = clip.channels.front().device;
    return device.highHz > device.lowHz ? FrequencyScale{device.lowHz, device.highHz} : defaultScale;
}

std::string summary(const ClipPart& part, std::size_t bytes) {
    return part.path + "  " + plural(part.clip.channels.size(), "channel") + ", " +
           fixedNumber(part.clip.seconds(), 2) + " s, " + plural(part.clip.points(), "keyframe") + ", " +
           fixedNumber(static_cast<double>(bytes) * 1e-3, 1) + " kB\n";
}

/// Time until the last event has decayed.
double durationSeconds(std::span<const CollisionEvent> events, int rate) {
    double end = 0.0;
    for (const CollisionEvent& event : events) {
        const auto decaySeconds =
            static_cast<double>(lifeFramesOf(decayIncrementOf(event.decayPerSecond, rate))) / rate;
        const double toneSeconds =
            event.durationNs > 0 ? 1e-9 * static_cast<double>(event.durationNs) : decaySeconds;
        end = std::max(end, 1e-9 * static_cast<double>(event.timeNs) + std::min(decaySeconds, toneSeconds));
    }
    return end;
}

} // namespace

Result<Clip> makeHitClip(const HitExport& hits, const EventClipSettings& settings) {
    if (const std::size_t found = hits.events.size(); found > limits::maxClipEvents)
        return Failure{hits.source + ": expected at most " + std::to_string(limits::maxClipEvents) +
                       " hits, found " + std::to_string(found)};
    Clip clip = clipFromEvents(stationaryEvents(hits.events), settings);
    clip.title = hits.title;
    clip.extentWidthMetres = hits.layout.geometry.extentWidthMetres;
    clip.extentHeightMetres = hits.layout.geometry.extentHeightMetres;
    for (std::size_t j = 0; j < std::min(clip.channels.size(), hits.layout.actuators.size()); ++j) {
        const auto device = makeDevice(hits, hits.layout.actuators[j]);
        if (!device) return Failure{device.error};
        clip.channels[j].label = hits.layout.actuators[j].label;
        clip.channels[j].place = hits.layout.geometry.places[j];
        clip.channels[j].device = device.value;
    }
    if (auto error = clipError(clip); !error.empty()) return Failure{hits.source + ": " + error};
    return clip;
}

std::vector<ClipPart> splitClip(const Clip& clip, const std::string& targetPath, ClipFormat format) {
    if (!isMono(format) || clip.channels.size() == 1) return {{targetPath, clip}};
    std::vector<ClipPart> parts;
    const std::filesystem::path path{targetPath};
    for (std::size_t j = 0; j < clip.channels.size(); ++j) {
        Clip mono{clip.title, 0.0, 0.0, {clip.channels[j]}};
        if (!(mono.seconds() > 0.0)) continue;
        std::string label = clip.channels[j].label.empty() ? std::to_string(j + 1) : clip.channels[j].label;
        std::ranges::replace_if(
            label, [](char c) { return c == '/' || static_cast<unsigned char>(c) < 0x20; }, '_');
        parts.push_back(
            {(path.parent_path() / (path.stem().string() + "-" + label + path.extension().string())).string(),
             std::move(mono)});
    }
    return parts;
}

std::string replacedPartError(const std::vector<ClipPart>& parts, const std::string& targetPath) {
    for (const ClipPart& part : parts)
        if (std::error_code code; part.path != targetPath && std::filesystem::exists(part.path, code))
            return part.path + ": is there already; a file for each actuator replaces none";
    return {};
}

Result<std::string> writeParts(const std::vector<ClipPart>& parts, ClipFormat format,
                               const FrequencyScale& defaultScale) {
    std::list<AtomicFile> files;
    std::string report;
    for (const ClipPart& part : parts) {
        const std::string bytes = clipBytes(part.clip, format, channelScale(part.clip, defaultScale));
        if (const std::string& error = files.emplace_back(part.path).error(); !error.empty())
            return Failure{error};
        if (const std::string& error = files.back().write(bytes); !error.empty()) return Failure{error};
        report += summary(part, bytes.size());
    }
    for (AtomicFile& file : files)
        if (const std::string& error = file.commit(); !error.empty()) return Failure{error};
    return report;
}

std::vector<std::string> listLosses(const std::vector<ClipPart>& parts, ClipFormat format,
                                    const FrequencyScale& defaultScale) {
    std::vector<std::string> losses;
    for (const ClipPart& part : parts)
        for (const std::string& loss : clipLosses(part.clip, format, channelScale(part.clip, defaultScale)))
            if (std::ranges::find(losses, loss) == losses.end()) losses.push_back(loss);
    return losses;
}

std::string writeHitsWav(const HitExport& hits, const PhantomPanner& panner, int sampleRateHz,
                         const std::string& path, const std::string& comment) {
    const double seconds = durationSeconds(hits.events, sampleRateHz);
    if (!(seconds <= limits::maxClipSeconds))
        return hits.source + ": expected at most " + plainNumber(limits::maxClipSeconds) +
               " seconds, found " + fixedNumber(seconds, 0);
    if (const double bytes = seconds * sampleRateHz * panner.channels() * sizeof(float); bytes > maxWavBytes)
        return hits.source + ": expected at most " + plainNumber(1e-6 * maxWavBytes) +
               " MB of samples, found " + fixedNumber(1e-6 * bytes, 0);
    const RendererSettings renderer{.sampleRateHz = sampleRateHz, .panner = panner, .limiterEnabled = false};
    WavSink wav{path, panner.channels(), sampleRateHz, comment};
    if (!wav.error().empty()) return wav.error();
    renderOffline(hits.events, {renderer, static_cast<std::int64_t>(std::ceil(seconds * sampleRateHz))},
                  [&](const float* const* block, int frames) { return wav.write(block, frames); });
    return wav.finish();
}

} // namespace physvib
