// SPDX-License-Identifier: MIT
// Renders a saved session: merges the events of its scene runs and inputs, then renders offline.
#include "Live/Session/SessionRender.h"
#include <algorithm>
#include <cmath>

namespace physvib {

SceneEvents sessionEvents(const SavedSession& session, std::int64_t endNs, const StepWatch& keepGoing) {
    SceneEvents all = runTakes(session.log.takes, session.run, endNs, keepGoing);
    for (const CollisionEvent& strike : session.log.strikes)
        if (strike.timeNs < endNs) all.events.push_back(strike);
    std::ranges::stable_sort(all.events, {}, &CollisionEvent::timeNs);
    return all;
}

bool renderSession(const SavedSession& session, const LoadedRecordings& loaded, const SessionExtent& extent,
                   const BlockConsumer& consume) {
    SessionRecordings recordings{session.log, loaded, extent.sampleRateHz};
    const std::int64_t endNs = std::llround(extent.seconds * 1e9);
    bool keepGoing = extent.progress(0.0);
    if (!keepGoing) return false;
    auto events = sessionEvents(session, endNs, [&](std::int64_t timeNs) {
                      return keepGoing = extent.progress(0.5 * static_cast<double>(timeNs) /
                                                         static_cast<double>(endNs));
                  }).events;
    if (!keepGoing) return false;
    std::ranges::transform(events, events.begin(), EventShaper{session.shaping});
    const auto controls = recordings.with(controlsOf(session.log, true, session.channels));
    const std::int64_t frames = std::llround(extent.seconds * extent.sampleRateHz);
    std::int64_t done = 0;
    const RendererSettings renderer{.sampleRateHz = extent.sampleRateHz,
                                    .channels = session.channels,
                                    .panner = session.panner,
                                    .limiterEnabled = session.limiterEnabled,
                                    .ceilings = session.ceilings,
                                    .equalised = session.equalised};
    renderOffline(events, {renderer, frames, 1024, controls, recordings.beside({})},
                  [&](const float* const* block, int n) {
                      done += n;
                      return keepGoing =
                                 consume(block, n) && extent.progress(0.5 + 0.5 * static_cast<double>(done) /
                                                                                static_cast<double>(frames));
                  });
    return keepGoing;
}

} // namespace physvib
