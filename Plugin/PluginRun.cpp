// SPDX-License-Identifier: GPL-3.0-or-later
// Renders one run: forwards its queued controls, lengthens and shortens its latency, and fades it at its end.
#include "PluginRun.h"
#include <algorithm>

namespace physvib {

PluginRun::PluginRun(std::shared_ptr<const RunSpec> spec, int sampleRateHz, int blockFrames,
                     StepTiming timing, bool hasMusic)
    : session{std::shared_ptr<const SessionSetup>{spec, &spec->setup}}
    , spec_{std::move(spec)}
    , sampleRateHz_{sampleRateHz}
    , sliceFrames_{std::max(1, sampleRateHz / slicesPerSecond)} {
    samples.assign(static_cast<std::size_t>(session.channels()),
                   std::vector<float>(static_cast<std::size_t>(blockFrames)));
    rewind(timing);
    if (!hasMusic) return;
    // L, the block that is written before it is rendered, and a block by which L may be changing
    const std::int64_t maxFrames = std::max(safeFrames_, tightFrames_) + 2 * blockFrames;
    music_ =
        std::make_unique<MusicDelay>(spec_->settings.layout, session.channels(), sampleRateHz, maxFrames);
    session.callback().add(*music_);
}

void PluginRun::rewind(StepTiming timing) {
    const int block = static_cast<int>(samples.front().size());
    session.prepare(sampleRateHz_, block);
    session.advance(); // steps what the first block needs
    const auto& setup = spec_->setup;
    safeFrames_ = tightFrames_ = session.timeline().outputLatencyFrames();
    if (setup.hasWorld)
        tightFrames_ = std::min(
            safeFrames_, ClockLaw{sampleRateHz_, 0, setup.stepsPerSecond,
                                  std::max(0.0, spec_->detectionDelaySeconds - 2.0 / setup.stepsPerSecond),
                                  HapticRenderer::latencyFramesAt(sampleRateHz_)}
                             .outputLatencyFrames());
    for (std::int64_t surplus = safeFrames_ - latencyFrames(timing); surplus > 0; surplus -= block)
        session.shortenLatency(outputsFrom(0).data(),
                               static_cast<int>(std::min<std::int64_t>(surplus, block)));
    fade_.prepare(sampleRateHz_, limits::channelRampSeconds, 1.0f);
    latencyGate_.prepare(sampleRateHz_, limits::channelRampSeconds, 1.0f);
    lastSamples_.fill(0.0f);
    framesUntilFade_ = -1;
    hasFaded_ = false;
    number = 0;
    loggedEventCount = 0;
    isReleased = false;
    if (music_) music_->reset();
    lastSent_ = {};
    queuedLevels_.clear();
    queuedPanners_.clear();
}

bool PluginRun::queueLevel(double gain, int frame) noexcept {
    return queuedLevels_.queue.push({session.timeline().framesRendered() + frame, gain, {}});
}

bool PluginRun::queueLaw(PanningLaw law, double exponent, int frame) noexcept {
    return queuedPanners_.queue.push({session.timeline().framesRendered() + frame, exponent, law});
}

// Sends the controls before frame `until` to the session, each as `make(QueuedControl)`. One that the
// session's full queue refuses stays first in line.
template <class Make>
void PluginRun::forwardControls(PendingControls& pending, std::int64_t until, Make make) noexcept {
    const std::int64_t now = session.timeline().framesRendered();
    while (pending.hasNext || (pending.hasNext = pending.queue.pop(pending.next))) {
        if (pending.next.frame >= until ||
            !session.callback().control(make(pending.next), static_cast<int>(pending.next.frame - now)))
            return;
        pending.hasNext = false;
    }
}

// Forwards the controls that act in the next `frames` frames of the renderer: a control acts L after its
// frame, less the renderer's own latency.
void PluginRun::forwardControlsUntil(int frames) noexcept {
    const auto& time = session.timeline();
    const std::int64_t until = time.framesRendered() + frames - time.inputLatencyFrames() +
                               HapticRenderer::latencyFramesAt(sampleRateHz_);
    forwardControls(queuedLevels_, until, [](const QueuedControl& queued) {
        return RenderControl{.kind = RenderControl::Kind::level, .value = static_cast<float>(queued.value)};
    });
    PhantomPanner panner;
    forwardControls(queuedPanners_, until, [&](const QueuedControl& queued) {
        const auto& settings = spec_->settings;
        panner = {settings.layout, queued.law, queued.value, settings.midi.fieldWidthMetres(),
                  settings.midi.fieldHeightMetres()};
        return RenderControl{.kind = RenderControl::Kind::panner, .panner = &panner};
    });
}

bool PluginRun::send(std::span<const Strip> strips) {
    return sendStrips(lastSent_, strips, [this](const RenderControl& control) {
        return session.submit({control}).error.empty();
    });
}

bool PluginRun::silence(int frame) noexcept {
    const auto& time = session.timeline();
    if (music_) music_->silence(time.nextRenderedFrame(frame), time.nextInputFrame(frame));
    return session.callback().silence(frame);
}

void PluginRun::end() noexcept {
    if (framesUntilFade_ < 0) framesUntilFade_ = session.timeline().inputLatencyFrames();
}

void PluginRun::render(int frames, StepTiming timing, RenderMode mode) noexcept {
    const std::int64_t surplus = session.timeline().outputLatencyFrames() - latencyFrames(timing);
    if (surplus > 0) {
        if (latencyGate_.current() > 0.0f) return play(0, frames, mode, 0.0f);
        skipSurplus(static_cast<int>(std::min<std::int64_t>(surplus, frames)));
        return play(0, frames, mode, surplus > frames ? 0.0f : 1.0f);
    }
    const int pauseFrames = static_cast<int>(std::clamp<std::int64_t>(-surplus, 0, frames));
    if (pauseFrames > 0) renderPause(pauseFrames);
    if (pauseFrames < frames) play(pauseFrames, frames - pauseFrames, mode);
}

std::array<float*, limits::maxActuators> PluginRun::outputsFrom(int frame) noexcept {
    std::array<float*, limits::maxActuators> outputs{};
    for (std::size_t j = 0; j < samples.size(); ++j) outputs[j] = samples[j].data() + frame;
    return outputs;
}

// Repeats the last samples and fades them to silence, because a step to zero could be felt.
void PluginRun::renderPause(int frames) noexcept {
    session.lengthenLatency(frames);
    for (std::size_t j = 0; j < samples.size(); ++j) std::fill_n(samples[j].data(), frames, lastSamples_[j]);
    latencyGate_.moveTo(0.0f);
    latencyGate_.apply(outputsFrom(0).data(), session.channels(), frames);
}

void PluginRun::skipSurplus(int frames) noexcept {
    forwardControlsUntil(frames);
    session.shortenLatency(outputsFrom(0).data(), frames);
    if (framesUntilFade_ > 0) framesUntilFade_ = std::max<std::int64_t>(0, framesUntilFade_ - frames);
}

void PluginRun::play(int first, int frames, RenderMode mode, float gateTarget) noexcept {
    const auto outputs = outputsFrom(first);
    for (int done = 0; done < frames;) {
        const int part = std::min(frames - done, sliceFrames_);
        forwardControlsUntil(part);
        session.render(outputsFrom(first + done).data(), part, mode);
        done += part;
    }
    fadeAtEnd(first, frames);
    for (std::size_t j = 0; j < samples.size(); ++j) lastSamples_[j] = outputs[j][frames - 1];
    latencyGate_.moveTo(gateTarget);
    latencyGate_.apply(outputs.data(), session.channels(), frames);
}

void PluginRun::fadeAtEnd(int first, int frames) noexcept {
    if (framesUntilFade_ < 0) return;
    const int soundingFrames = static_cast<int>(std::min<std::int64_t>(framesUntilFade_, frames));
    framesUntilFade_ -= soundingFrames;
    if (soundingFrames == frames) return;
    fade_.moveTo(0.0f);
    fade_.apply(outputsFrom(first + soundingFrames).data(), session.channels(), frames - soundingFrames);
    hasFaded_ = fade_.isResting();
}

} // namespace physvib
