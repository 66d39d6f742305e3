// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a movie of a session: computes first its events, then its samples, then the pictures.
#include "Calls/MovieOutput.h"
#include "Calls/RenderJob.h"
#include "Io/Disk/FileClash.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Session/ContactAudio.h"
#include "Live/Session/SessionRender.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr int movieRateHz = 8'000; // a column of the waveform picture is 40 ms
constexpr int soundRateHz = 48'000, soundChannels = 2;
// shares of the total time, for the progress report; ffmpeg's own work follows, if there is sound
constexpr double eventsShare = 0.1, samplesShare = 0.3, picturesShareBeforeFfmpeg = 0.8;

/// Part of a session from session time `fromNs` to `endNs`.
struct MoviePart {
    std::int64_t fromNs, endNs;
    double seconds() const { return 1e-9 * static_cast<double>(endNs - fromNs); }
    std::int64_t frames(std::int64_t ns) const {
        return std::llround(1e-9 * static_cast<double>(ns) * movieRateHz);
    }
};

std::vector<CollisionEvent> partEvents(const SavedSession& session, const MoviePart& part,
                                       const StepWatch& keepGoing) {
    auto events = sessionEvents(session, part.endNs, keepGoing).events;
    EventShaper{session.shaping}.shape(events); // whole: a fixed level depends on what was played before
    std::erase_if(events, [&](const CollisionEvent& e) { return e.timeNs < part.fromNs; });
    for (CollisionEvent& event : events) event.timeNs -= part.fromNs;
    return events;
}

/// The controls of the part. Earlier ones that still apply, such as a layout, act at its start.
std::vector<RenderControl> partControls(const SavedSession& session, const MoviePart& part) {
    auto controls = logControls(session.log, true, session.channels);
    std::erase_if(controls, [&](const RenderControl& control) {
        return control.kind == RenderControl::Kind::stopAll && control.timeNs < part.fromNs;
    });
    for (RenderControl& control : controls)
        control.timeNs = std::max<std::int64_t>(0, control.timeNs - part.fromNs);
    return controls;
}

/// Writes the sound that the mixer's monitor would play; false if cancelled.
bool writeContactSound(MovieOutput& movie, const SavedSession& session, const MoviePart& part,
                       const std::vector<CollisionEvent>& hits, const std::function<bool()>& keepGoing) {
    bool isComplete = true;
    ContactAudioRender settings{soundRateHz, std::llround(part.seconds() * soundRateHz)};
    settings.channels = soundChannels;
    settings.field = session.panner;
    settings.levelDb = defaultContactDb;
    renderContactAudio(hits, partControls(session, part), settings,
                       [&](const float* const* channels, int frames) {
                           return isComplete = movie.writeSound(channels, frames) && keepGoing();
                       });
    return isComplete;
}

} // namespace

std::string writeSessionMovie(const SavedSession& session, const LayoutDescription& layout, double seconds,
                              const std::string& path, const std::function<bool(double)>& progress) {
    const MoviePart part{std::max<std::int64_t>(0, session.lengthNs - std::llround(seconds * 1e9)),
                         session.lengthNs};
    const auto recordings = loadRecordings(session.log);
    if (!recordings) return recordings.error;
    if (auto clash = fileClashError({&path, 1}, recordingPaths(session.log)); !clash.empty()) return clash;
    MovieOutput movie{path, soundRateHz, soundChannels};
    if (!movie.error().empty()) return movie.error();

    bool keepGoing = true;
    const auto events = partEvents(session, part, [&](std::int64_t timeNs) {
        const std::int64_t done = std::min(timeNs, part.endNs); // the last step may exceed the end
        return keepGoing = progress(eventsShare * static_cast<double>(done) /
                                    static_cast<double>(std::max<std::int64_t>(1, part.endNs)));
    });
    if (!keepGoing) return "cancelled";
    WaveformEnvelope waveform{layout.geometry.count, part.frames(part.fromNs),
                              part.frames(part.endNs - part.fromNs)};
    const SessionExtent extent{movieRateHz, 1e-9 * static_cast<double>(part.endNs), [&](double share) {
                                   return progress(eventsShare + (samplesShare - eventsShare) * share);
                               }};
    if (!renderSession(session, recordings.value, extent,
                       [&](const float* const* block, int n) { return waveform.add(block, n), true; }))
        return "cancelled";
    if (movie.hasSound() &&
        !writeContactSound(movie, session, part, events,
                           [&] { return keepGoing = progress(samplesShare); }) &&
        !keepGoing)
        return "cancelled";

    const SceneRun& lastRun = session.log.runs.back();
    PictureInput picture;
    picture.title = lastRun.scene->name;
    picture.fieldWidthMetres = lastRun.scene->fieldWidthMetres;
    picture.fieldHeightMetres = lastRun.scene->fieldHeightMetres;
    const Scene fullScene = lastRun.fullScene();
    picture.scene = &fullScene;
    picture.events = events;
    for (const SceneRun& run : session.log.runs) picture.runStartsNs.push_back(run.startNs - part.fromNs);
    picture.layout = layout.geometry;
    for (const auto& actuator : layout.actuators) picture.labels.push_back(actuator.label);
    picture.waveform = &waveform;
    picture.sampleRateHz = movieRateHz;
    picture.durationSeconds = part.seconds();
    const PoseSource bodies = [&](std::int64_t everyNs, std::int64_t endNs, const RunPoseWatch& watch) {
        followRuns(session.log.runs, session.run, part.fromNs, everyNs,
                   std::min(part.endNs, part.fromNs + endNs),
                   [&](std::int64_t timeNs, const Scene& scene, const WorldPoses& poses) {
                       return watch(timeNs - part.fromNs, scene, poses);
                   });
    };
    const double drawnShare = movie.hasSound() ? picturesShareBeforeFfmpeg : 1.0;
    const std::string error = movie.draw(picture, bodies, [&](double share) {
        return progress(samplesShare + (drawnShare - samplesShare) * share);
    });
    return error.empty() ? movie.commit() : error;
}

} // namespace physvib
