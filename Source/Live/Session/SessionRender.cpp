// SPDX-License-Identifier: MIT
// Renders a saved session: merges the events of its scene runs and inputs, then renders offline. Renders
// stimuli in g and scales them to each actuator's full scale.
#include "Live/Session/SessionRender.h"

namespace physvib {

SceneEvents sessionEvents(const SavedSession& session, std::int64_t endNs, const StepWatch& keepGoing) {
    SceneEvents all = simulateRuns(session.log.runs, session.run, endNs, keepGoing);
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
    const auto controls = recordings.mergedWith(logControls(session.log, true, session.channels));
    const std::int64_t frames = std::llround(extent.seconds * extent.sampleRateHz);
    std::int64_t done = 0;
    const RendererSettings renderer{.sampleRateHz = extent.sampleRateHz,
                                    .channels = session.channels,
                                    .panner = session.panner,
                                    .limiterEnabled = session.limiterEnabled,
                                    .ceilings = session.ceilings,
                                    .equalised = session.equalised};
    renderOffline(events, {renderer, frames, 1024, controls, recordings.withClips({})},
                  [&](const float* const* block, int n) {
                      done += n;
                      return keepGoing =
                                 consume(block, n) && extent.progress(0.5 + 0.5 * static_cast<double>(done) /
                                                                                static_cast<double>(frames));
                  });
    return keepGoing;
}

std::vector<std::string> recordingNotes(const LoadedRecordings& loaded) {
    std::vector<std::string> notes = recordingNotes(loaded.clips);
    for (const auto& set : loaded.sets)
        for (std::string& note : recordingNotes(set))
            if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
    return notes;
}

SessionRecordings::SessionRecordings(const SessionLog& log, const LoadedRecordings& loaded, int sampleRateHz)
    : sampleRateHz_{sampleRateHz} {
    for (const ContactRecording& clip : loaded.clips) sets_.add(clip);
    for (std::size_t i = 0; i < log.recordings.size() && i < loaded.setIndices.size(); ++i) {
        RenderControl& control = changes_.emplace_back();
        control.timeNs = log.recordings[i].timeNs;
        control.kind = RenderControl::Kind::recordings;
        control.recordings = sets_.contacts(sampleRateHz, loaded.sets[loaded.setIndices[i]]);
    }
}

std::vector<RenderControl> SessionRecordings::mergedWith(std::vector<RenderControl> controls) const {
    controls.insert(controls.end(), changes_.begin(), changes_.end());
    std::ranges::stable_sort(controls, {}, &RenderControl::timeNs);
    return controls;
}

namespace {

double peakOf(const std::vector<float>& samples) {
    double peak = 0.0;
    for (const float s : samples) peak = std::max(peak, static_cast<double>(std::abs(s)));
    return peak;
}

/// Scales samples in g to shares of each actuator's full scale, or returns an error if they exceed it.
Result<StimulusSound> scaledToFullScale(StimulusSound sound, const LayoutDescription& layout) {
    for (std::size_t j = 0; j < sound.channels.size(); ++j) {
        const auto& actuator = layout.actuators[j];
        const double peakG = peakOf(sound.channels[j]);
        if (!std::isfinite(peakG) || peakG > actuator.fullScaleG * (1.0 + fullScaleSlack))
            return Failure{"actuator " + actuator.label + ": expected at most its full scale of " +
                           numberText(actuator.fullScaleG) + " g, found " + fixedNumber(peakG, 3) + " g"};
        for (float& s : sound.channels[j]) s = static_cast<float>(s / actuator.fullScaleG);
    }
    return sound;
}

} // namespace

RendererSettings rendererFor(const Stimulus& stimulus, int sampleRateHz) {
    RendererSettings settings{sampleRateHz, 0, stimulus.panner, false};
    settings.modes = static_cast<int>(
        std::clamp<std::size_t>(stimulus.events.size(), 1, static_cast<std::size_t>(limits::maxModes)));
    return settings;
}

Result<StimulusSound> renderStimulus(const Stimulus& stimulus, const LayoutDescription& layout,
                                     int sampleRateHz) {
    const auto channels = static_cast<std::size_t>(stimulus.panner.channels());
    for (const auto& event : stimulus.events)
        if (event.frequencyHz >= 0.5 * sampleRateHz)
            return Failure{"expected a frequency below half the rate of " + std::to_string(sampleRateHz) +
                           " Hz, found " + numberText(event.frequencyHz) + " Hz"};
    StimulusSound sound{sampleRateHz, std::vector<std::vector<float>>(channels)};
    const OfflineSettings settings{rendererFor(stimulus, sampleRateHz),
                                   std::llround(stimulus.seconds * sampleRateHz)};
    renderOffline(stimulus.events, settings, [&](const float* const* blocks, int frames) {
        for (std::size_t j = 0; j < channels; ++j)
            sound.channels[j].insert(sound.channels[j].end(), blocks[j], blocks[j] + frames);
        return true;
    });
    return scaledToFullScale(std::move(sound), layout);
}

Result<StimulusSound> placeRecording(const StimulusSound& recording, const FieldPlace& place, double levelG,
                                     const PhantomPanner& panner, const LayoutDescription& layout) {
    const std::vector<float>& samples = recording.channels.front();
    const double peak = peakOf(samples);
    if (!(peak > 0.0) || !std::isfinite(peak))
        return Failure{"expected a recording with a finite peak, found " + numberText(peak)};
    PhantomPanner::Gains gains{};
    const auto& geometry = layout.geometry;
    panner.gainsAt(place.x * geometry.extentWidthMetres, (1.0 - place.y) * geometry.extentHeightMetres,
                   gains);
    StimulusSound sound{recording.sampleRateHz,
                        std::vector<std::vector<float>>(layout.actuators.size(), samples)};
    for (std::size_t j = 0; j < sound.channels.size(); ++j)
        for (float& s : sound.channels[j]) s = static_cast<float>(s * (levelG / peak * gains[j]));
    return scaledToFullScale(std::move(sound), layout);
}

} // namespace physvib
