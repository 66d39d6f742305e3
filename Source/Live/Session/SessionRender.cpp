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
    EventShaper{session.shaping}.shape(events);
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

std::vector<std::string> notesOf(const LoadedRecordings& loaded) {
    std::vector<std::string> notes = notesOf(loaded.clips);
    for (const auto& set : loaded.sets)
        for (std::string& note : notesOf(set))
            if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
    return notes;
}

SessionRecordings::SessionRecordings(const SessionLog& log, const LoadedRecordings& loaded, int sampleRateHz)
    : sampleRateHz_{sampleRateHz} {
    for (const ContactRecording& clip : loaded.clips) sets_.add(clip);
    for (std::size_t i = 0; i < log.recordings.size() && i < loaded.setOfChange.size(); ++i) {
        RenderControl& control = changes_.emplace_back();
        control.timeNs = log.recordings[i].timeNs;
        control.kind = RenderControl::Kind::recordings;
        control.recordings = sets_.at(sampleRateHz, loaded.sets[loaded.setOfChange[i]]);
    }
}

std::vector<RenderControl> SessionRecordings::with(std::vector<RenderControl> controls) const {
    controls.insert(controls.end(), changes_.begin(), changes_.end());
    std::ranges::stable_sort(controls, {}, &RenderControl::timeNs);
    return controls;
}

} // namespace physvib
