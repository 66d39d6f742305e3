// SPDX-License-Identifier: GPL-3.0-or-later
// Writes temporary files and renames them at the end; prints progress on a terminal only.
#include "CommandLine/Render/RenderOutputs.h"
#include "Calls/LoadedRender.h"
#include "Calls/RenderJob.h"
#include "Core/Limits.h"
#include "Core/Units.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/NumberText.h"
#include "Pictures/RenderPicture.h"
#include "Pictures/WaveformEnvelope.h"
#include "Scene/EventsCsv.h"
#include "Scene/FieldSize.h"
#include "System/Process.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <ostream>
#include <string>

namespace physvib {

inline std::string levelText(double g) { return fixedNumber(g, g < 0.1 ? 4 : 2) + " g"; }

/// "peak -6.0 dBFS (0.50 g)", in g of the actuator that moves most. An equalised channel contains the drive
/// signal, so the acceleration is that before equalisation, not that of the samples in the file.
inline std::string peakText(const LoadedRender& job, const WaveformEnvelope& envelope) {
    if (!(envelope.peak() > 0.0f)) {
        const std::string reason =
            job.clip ? ""
                     : silenceReason(job.collisions.events, job.panner(), job.hasGuessedField(), job.endNs());
        return "silent" + (reason.empty() ? "" : ": " + reason);
    }
    std::string text = "peak " + fixedNumber(toDecibels(static_cast<double>(envelope.peak())), 1) + " dBFS";
    const auto equalised = job.equalised();
    if (std::ranges::any_of(equalised, &EqualisedActuator::isKnown)) return "drive " + text;
    double maxG = 0.0;
    for (int j = 0; j < envelope.channels(); ++j)
        maxG = std::max(
            maxG,
            static_cast<double>(envelope.peak(j)) *
                job.layout.actuators[std::min(static_cast<std::size_t>(j), job.layout.actuators.size() - 1)]
                    .fullScaleG);
    return text + " (" + levelText(maxG) + ")";
}

/// "48 collisions, 0.0020 g to 0.42 g, 3 under one step of an 8-bit converter": each event counts at the
/// actuator that it is strongest at.
inline std::string collisionText(const LoadedRender& job) {
    constexpr double converterStep = 1.0 / 128.0; // of full scale: the board's converters
    auto events = job.collisions.events;
    std::erase_if(events, isMeanCompensation);
    std::string text = plural(events.size(), "collision");
    if (events.empty()) return text;
    const PhantomPanner panner = job.panner();
    PhantomPanner::Gains gains{};
    double minG = HUGE_VAL, maxG = 0.0;
    std::size_t belowStep = 0;
    for (const CollisionEvent& e : events) {
        panner.gainsAt(e, gains);
        double level = 0.0, g = 0.0;
        for (std::size_t j = 0;
             j < std::min(static_cast<std::size_t>(panner.channels()), job.layout.actuators.size()); ++j) {
            level = std::max(level, std::abs(e.amplitude * gains[j]));
            g = std::max(g, std::abs(e.amplitude * gains[j]) * job.layout.actuators[j].fullScaleG);
        }
        minG = std::min(minG, g);
        maxG = std::max(maxG, g);
        belowStep += level < converterStep ? 1 : 0;
    }
    return text + ", " + levelText(minG) + " to " + levelText(maxG) + ", " + std::to_string(belowStep) +
           " under one step of an 8-bit converter";
}

namespace {

/// Opens the file if its path is not empty.
std::string openIfNamed(auto& file, const std::string& path, const auto&... arguments) {
    return path.empty() ? std::string{} : file.emplace(path, arguments...).error();
}

} // namespace

RenderOutputs::RenderOutputs(const LoadedRender& job)
    : job_{job}
    , onOffPattern_{job.channels(), job.options.sampleRateHz, job.options.threshold}
    , envelope_{job.channels(), 0, job.frames()} {}

std::string RenderOutputs::open() {
    const RenderJob& o = job_.options;
    std::string error = o.pad.empty()
                            ? openIfNamed(wav_, o.wavPath, job_.channels(), o.sampleRateHz, provenanceText())
                            : openMotors();
    const std::string text = provenanceText();
    if (error.empty())
        error = openIfNamed(contactWav_, o.contactSound, o.contactSoundChannels, o.sampleRateHz,
                            text + " heard=contact_sound");
    if (error.empty())
        error = openIfNamed(markerWav_, o.marker, 1, o.sampleRateHz,
                            text + " marked=" + std::string{nameOf(o.markedOnsets)});
    for (const auto& [file, path] : {std::pair{&eventsFile_, &o.eventsPath},
                                     {&pictureFile_, &o.picturePath},
                                     {&patternFile_, &o.patternPath}})
        if (error.empty()) error = openIfNamed(*file, *path);
    if (error.empty()) error = openIfNamed(movie_, o.moviePath, o.sampleRateHz, o.contactSoundChannels);
    return error;
}

std::string RenderOutputs::openMotors() {
    auto pad = findPad(job_.options.pad);
    if (!pad) return "--pad: " + pad.error;
    padProfile_ = std::move(pad.value);
    return openIfNamed(motorsFile_, job_.options.wavPath);
}

void RenderOutputs::computeMotorCommands(const std::vector<RenderControl>& controls) {
    if (motorsFile_)
        motorCommands_ =
            padCommands(padProfile_.law, job_.collisions.events, controls, job_.panner(), job_.endNs());
}

void RenderOutputs::startZoom() {
    const FrameWindow window = zoomWindow(job_.collisions.events, job_.options.sampleRateHz);
    zoomEnvelope_.emplace(job_.channels(), window.firstFrame, window.frameCount);
}

bool RenderOutputs::write(const float* const* channels, int frames) {
    framesWritten_ += frames;
    envelope_.add(channels, frames);
    zoomEnvelope_->add(channels, frames);
    showProgress();
    if (patternFile_) onOffPattern_.convert(channels, frames);
    return !wav_ || writeWav(channels, frames);
}

bool RenderOutputs::writeWav(const float* const* channels, int frames) {
    if (!(job_.options.interfaceVolts > 0.0)) return wav_->write(channels, frames);
    return wav_->write(voltBlock_.copyScaled(channels, job_.channels(), frames, job_.actuators.voltageScale),
                       frames);
}

bool RenderOutputs::writeContactSound(const float* const* channels, int frames) {
    if (movie_ && movie_->hasSound() && !movie_->writeSound(channels, frames)) return false;
    return !contactWav_ || contactWav_->write(channels, frames);
}

void RenderOutputs::setMarkSummary(const OnsetMarks& marks) { markSummary_ = physvib::markSummary(marks); }

std::string RenderOutputs::finish() {
    std::string error;
    for (auto* wav : {&wav_, &contactWav_, &markerWav_})
        if (error.empty() && *wav) error = (*wav)->complete();
    if (error.empty() && eventsFile_)
        error = eventsFile_->write(
            eventsCsv(job_.collisions.events, job_.statedField(), provenance(), job_.names()));
    if (error.empty() && movie_) error = movie_->draw(pictureInput(), poses());
    if (error.empty() && pictureFile_) error = writePictureFile();
    if (error.empty() && patternFile_) error = patternFile_->write(onOffPattern_.csv(provenance()));
    if (error.empty() && motorsFile_) error = motorsFile_->write(motorsCsv(motorCommands_, provenance()));
    for (auto* wav : {&wav_, &contactWav_, &markerWav_})
        if (error.empty() && *wav) error = (*wav)->finish();
    for (auto* file : {&eventsFile_, &pictureFile_, &patternFile_, &motorsFile_})
        if (error.empty() && *file) error = (*file)->commit();
    if (error.empty() && movie_) error = movie_->commit();
    return error;
}

Provenance RenderOutputs::provenance() const {
    const RenderJob& o = job_.options;
    Provenance p = inputProvenance();
    const auto add = [&p](const char* key, std::string value) {
        p.entries.emplace_back(key, std::move(value));
    };
    if (!job_.method().fixesNothing() || o.playsRecordings) add("method", o.methodName());
    if (job_.method().fixesAmplitude && !job_.method().holdsLevel) add("fixed-level", "each");
    if (o.limiting == Limiting::blocks) add("limiter", "blocks");
    if (o.levelDb != 0.0) add("level_db", numberText(o.levelDb));
    if (o.isWeighted) add("perceived_level", "on");
    for (const RecordedSound& sound : o.sounds)
        add("sound", sound.name() + '=' + fileNameOf(sound.path) + (o.matchesStrength ? ":rms" : ""));
    if (o.actuator != "none") add("actuator", fileNameOf(o.actuator));
    if (o.actuator != "none" && !o.isEqualised) add("equalise", "off");
    if (!o.pad.empty()) add("pad", padProfile_.name);
    if (o.interfaceVolts > 0.0) add("interface_volts", numberText(o.interfaceVolts));
    if (o.isRemapped) add("remap", "on");
    if (!o.coupling.empty()) add("coupling", fileNameOf(o.coupling));
    return p;
}

Provenance RenderOutputs::inputProvenance() const {
    const RenderJob& o = job_.options;
    if (job_.clip) return {PHYSVIB_VERSION, {{"clip", fileNameOf(o.scene)}}};
    if (!job_.scene) return {PHYSVIB_VERSION, {{"events", std::to_string(job_.collisions.events.size())}}};
    Provenance p{PHYSVIB_VERSION,
                 {{"scene", job_.scene->name},
                  {"seed", std::to_string(job_.session ? job_.session->log.runs.front().seed : o.seed)},
                  {"steps_per_second", std::to_string(job_.settings().stepsPerSecond)}}};
    if (job_.session) p.entries.emplace_back("session", fileNameOf(o.scene));
    if (job_.settings().timing != ImpactTiming::onset) p.entries.emplace_back("timing", "release");
    if (job_.settings().location != ImpactLocation::contact) p.entries.emplace_back("location", "fixture");
    for (const SceneVariable& variable : job_.scene->variables)
        p.entries.emplace_back(variable.name, variable.value);
    return p;
}

std::string RenderOutputs::provenanceText() const {
    const Provenance p = provenance();
    std::string text = "physvib " + p.version;
    for (const auto& [key, value] : p.entries) text += ' ' + key + '=' + value;
    return text;
}

RunSettings RenderOutputs::sceneRun() const {
    RunSettings run = job_.settings();
    if (job_.session) run.seed = job_.session->log.runs.front().seed;
    return run;
}

PoseSource RenderOutputs::poses() const {
    if (!job_.scene) return {};
    return [this](std::int64_t intervalNs, std::int64_t endNs, const RunPoseWatch& onPose) {
        if (job_.session) return followRuns(job_.session->log.runs, sceneRun(), 0, intervalNs, endNs, onPose);
        followPoses(
            *job_.scene, sceneRun(), intervalNs, endNs,
            [&](std::int64_t timeNs, const WorldPoses& poses) { return onPose(timeNs, *job_.scene, poses); });
    };
}

PictureInput RenderOutputs::pictureInput() const {
    const auto& events = job_.collisions.events;
    PictureInput picture;
    picture.title = job_.scene ? job_.scene->name : fileNameOf(job_.source());
    picture.subtitle = job_.scene ? job_.scene->description : job_.clip ? "a clip" : "an event list";
    picture.fieldWidthMetres = job_.fieldWidthMetres();
    picture.fieldHeightMetres = job_.fieldHeightMetres();
    picture.scene = job_.scene ? &*job_.scene : nullptr;
    picture.events = events;
    if (job_.session)
        for (const SceneRun& run : job_.session->log.runs) picture.runStartsNs.push_back(run.startNs);
    picture.layout = job_.layout.geometry;
    for (const auto& actuator : job_.layout.actuators) picture.labels.push_back(actuator.label);
    picture.waveform = &envelope_;
    picture.zoom = &*zoomEnvelope_;
    picture.sampleRateHz = job_.options.sampleRateHz;
    picture.durationSeconds = job_.seconds();
    picture.law = std::string{nameOf(job_.panner().law())} + " law";
    picture.provenance = provenanceText();
    return picture;
}

std::string RenderOutputs::writePictureFile() {
    PictureInput picture = pictureInput();
    if (job_.scene) picture.poses = posesAtStrongest(*job_.scene, sceneRun(), job_.collisions.events);
    return pictureFile_->write(picturePng(picture));
}

void RenderOutputs::showProgress() {
    static const bool isTerminal = isErrorTerminal();
    const int percent = static_cast<int>(100 * framesWritten_ / job_.frames());
    if (!isTerminal || percent == lastPercent_) return;
    lastPercent_ = percent;
    std::fprintf(stderr, percent < 100 ? "\rrendering %d %%" : "\r                \r", percent);
}

void RenderOutputs::summarise(std::ostream& out) const {
    const RenderJob& o = job_.options;
    out << std::fixed << std::setprecision(1);
    if (wav_) {
        out << o.wavPath << "  " << job_.channels() << (job_.channels() == 1 ? " channel, " : " channels, ")
            << job_.seconds() << " s at " << o.sampleRateHz << " Hz, " << peakText(job_, envelope_) << '\n';
    }
    if (motorsFile_)
        out << o.wavPath << "  what two motors of " << padProfile_.name
            << " would get: " << motorCommands_.size() << " commands\n";
    if (eventsFile_) out << o.eventsPath << "  " << collisionText(job_) << '\n';
    if (patternFile_)
        out << o.patternPath << "  on and off, above " << numberText(o.threshold) << " of full scale\n";
    if (contactWav_)
        out << o.contactSound << "  what is heard of each hit: " << o.contactSoundChannels
            << (o.contactSoundChannels == 1 ? " channel" : " channels") << ", at full scale "
            << numberText(o.contactSoundDb) << " dBFS\n";
    if (markerWav_) out << o.marker << "  a pulse at each onset: 1 channel, " << markSummary_ << '\n';
    if (movie_)
        out << o.moviePath << "  the world, its impacts and every channel in time, "
            << RenderMovie::picturesPerSecond << " pictures per second\n";
    if (pictureFile_)
        out << o.picturePath
            << (job_.clip ? "  every channel\n" : "  the world, every channel and every hit\n");
}

} // namespace physvib
