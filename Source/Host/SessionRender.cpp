// SPDX-License-Identifier: GPL-3.0-or-later
// The events of takes and strikes merged, then the offline renderer into a file.
#include "Host/SessionRender.h"
#include "Files/FileClash.h"
#include "Host/OfflineRender.h"
#include "Host/SessionRecordings.h"
#include "Host/WavSink.h"
#include <algorithm>
#include <cmath>

namespace physvib {

SceneEvents sessionEvents(const SavedSession& session, std::int64_t endNs, const StepWatch& goesOn) {
    SceneEvents all = runTakes(session.log.takes, session.run, endNs, goesOn);
    for (const CollisionEvent& strike : session.log.strikes)
        if (strike.timeNs < endNs) all.events.push_back(strike);
    std::ranges::stable_sort(all.events, {}, &CollisionEvent::timeNs);
    return all;
}

std::string renderSession(const SavedSession& session, const std::string& path, int sampleRateHz, double seconds, const std::string& comment,
                          const std::function<bool(double)>& progress) {
    const auto loaded = loadRecordings(session.log);
    if (!loaded) return loaded.error;
    if (auto clash = fileClash({&path, 1}, recordingPaths(session.log)); !clash.empty()) return clash;
    const SessionRecordings recordings{session.log, loaded.value, sampleRateHz};
    WavSink wav{path, session.channels, sampleRateHz, comment};
    if (!wav.error().empty()) return wav.error();
    if (!progress(0.0)) return "cancelled";
    const std::int64_t endNs = std::llround(seconds * 1e9);
    bool goesOn = true;
    auto events = sessionEvents(session, endNs, [&](std::int64_t timeNs) { return goesOn = progress(0.5 * static_cast<double>(timeNs) / static_cast<double>(endNs)); }).events;
    if (!goesOn) return "cancelled";
    std::ranges::transform(events, events.begin(), session.shaping);
    const auto controls = recordings.with(controlsOf(session.log, true, session.channels));
    const std::int64_t frames = std::llround(seconds * sampleRateHz);
    std::int64_t done = 0;
    const RendererSettings renderer{.sampleRateHz = sampleRateHz,
                                    .channels = session.channels,
                                    .panner = session.panner,
                                    .limiterEnabled = session.limiterEnabled,
                                    .ceilings = session.ceilings,
                                    .equalised = session.equalised};
    renderOffline(events, {renderer, frames, 1024, controls},
                  [&](const float* const* block, int n) {
                      done += n;
                      return wav.write(block, n) && (goesOn = progress(0.5 + 0.5 * static_cast<double>(done) / static_cast<double>(frames)));
                  });
    if (!goesOn) return "cancelled";
    return wav.finish();
}

} // namespace physvib
