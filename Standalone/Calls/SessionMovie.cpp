// SPDX-License-Identifier: GPL-3.0-or-later
// Creates a movie of a session: first its events, then its samples, then the pictures.
#include "Calls/SessionMovie.h"
#include "Calls/MovieOutput.h"
#include "Io/Disk/FileClash.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Session/SessionRender.h"
#include <algorithm>
#include <cmath>
#include <optional>

namespace physvib {
namespace {

constexpr int movieRateHz = 8'000;                      // a column of the waveform picture is 40 ms
constexpr double eventsShare = 0.1, samplesShare = 0.3; // shares of the total time, for the progress report

/// Part of a session; its first frame is at session time `fromNs`.
struct MoviePart {
    std::int64_t fromNs, endNs;
    double seconds() const { return 1e-9 * static_cast<double>(endNs - fromNs); }
    std::int64_t frames(std::int64_t ns) const {
        return std::llround(1e-9 * static_cast<double>(ns) * movieRateHz);
    }
};

std::vector<CollisionEvent> eventsOf(const SavedSession& session, const MoviePart& part,
                                     const StepWatch& goesOn) {
    auto events = sessionEvents(session, part.endNs, goesOn).events;
    std::erase_if(events, [&](const CollisionEvent& e) { return e.timeNs < part.fromNs; });
    std::ranges::transform(events, events.begin(), EventShaper{session.shaping});
    for (CollisionEvent& event : events) event.timeNs -= part.fromNs;
    return events;
}

} // namespace

std::string writeSessionMovie(const SavedSession& session, const LayoutDescription& layout, double seconds,
                              const std::string& path, const std::function<bool(double)>& progress) {
    const MoviePart part{std::max<std::int64_t>(0, session.lengthNs - std::llround(seconds * 1e9)),
                         session.lengthNs};
    const auto loaded = loadRecordings(session.log);
    if (!loaded) return loaded.error;
    if (auto clash = fileClash({&path, 1}, recordingPaths(session.log)); !clash.empty()) return clash;
    MovieOutput movie{path, movieRateHz};
    if (!movie.error().empty()) return movie.error();

    bool goesOn = true;
    const auto events = eventsOf(session, part, [&](std::int64_t timeNs) {
        const std::int64_t done = std::min(timeNs, part.endNs); // the last step may exceed the end
        return goesOn = progress(eventsShare * static_cast<double>(done) /
                                 static_cast<double>(std::max<std::int64_t>(1, part.endNs)));
    });
    if (!goesOn) return "cancelled";
    WaveformEnvelope waveform{layout.geometry.count, part.frames(part.fromNs),
                              part.frames(part.endNs - part.fromNs)};
    const SessionExtent extent{movieRateHz, 1e-9 * static_cast<double>(part.endNs), [&](double share) {
                                   return progress(eventsShare + (samplesShare - eventsShare) * share);
                               }};
    if (!renderSession(session, loaded.value, extent,
                       [&](const float* const* block, int n) { return waveform.add(block, n), true; }))
        return "cancelled";

    const SceneTake& last = session.log.takes.back();
    PictureInput picture;
    picture.title = last.scene->name;
    picture.fieldWidthMetres = last.scene->fieldWidthMetres;
    picture.fieldHeightMetres = last.scene->fieldHeightMetres;
    const Scene whole = last.whole();
    picture.scene = &whole;
    picture.events = events;
    picture.layout = layout.geometry;
    for (const auto& enchanter : layout.enchanters) picture.labels.push_back(enchanter.label);
    picture.waveform = &waveform;
    picture.sampleRateHz = movieRateHz;
    picture.durationSeconds = part.seconds();
    const PoseSource bodies = [&](std::int64_t everyNs, std::int64_t endNs, const TakeWatch& see) {
        followTakes(session.log.takes, session.run, part.fromNs, everyNs,
                    std::min(part.endNs, part.fromNs + endNs),
                    [&](std::int64_t timeNs, const Scene& scene, std::span<const BodyPose> poses) {
                        return see(timeNs - part.fromNs, scene, poses);
                    });
    };
    const std::string error = movie.draw(
        picture, bodies, [&](double share) { return progress(samplesShare + (1.0 - samplesShare) * share); });
    return error.empty() ? movie.commit() : error;
}

} // namespace physvib
