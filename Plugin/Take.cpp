// SPDX-License-Identifier: GPL-3.0-or-later
// Rendering, latency growth and end of a scene run.
#include "Take.h"
#include <algorithm>

namespace physvib {

Take::Take(std::shared_ptr<const TakeSpec> order, int sampleRateHz, int blockFrames, TakeTiming timing,
           bool hasMusic)
    : session{std::shared_ptr<const SessionSetup>{order, &order->setup}}
    , order_{std::move(order)}
    , sampleRateHz_{sampleRateHz}
    , sliceFrames_{std::max(1, sampleRateHz / slicesPerSecond)} {
    out.assign(static_cast<std::size_t>(session.channels()),
               std::vector<float>(static_cast<std::size_t>(blockFrames)));
    rewind(timing);
    if (!hasMusic) return;
    // L, the block before it is rendered, and one by which L may just be changing
    const std::int64_t longest = std::max(safeFrames_, tightFrames_) + 2 * blockFrames;
    music_ = std::make_unique<MusicDelay>(order_->settings.layout, session.channels(), sampleRateHz, longest);
    session.callback().add(*music_);
}

void Take::rewind(TakeTiming timing) {
    const int block = static_cast<int>(out.front().size());
    session.prepare(sampleRateHz_, block);
    session.advance(); // its time begins with the first block
    const auto& setup = order_->setup;
    safeFrames_ = tightFrames_ = session.timeline().outputLatencyFrames();
    if (setup.hasWorld)
        tightFrames_ = std::min(
            safeFrames_, ClockLaw{sampleRateHz_, 0, setup.stepsPerSecond,
                                  std::max(0.0, order_->knownAfterSeconds - 2.0 / setup.stepsPerSecond),
                                  HapticRenderer::latencyFramesAt(sampleRateHz_)}
                             .outputLatencyFrames());
    for (std::int64_t surplus = safeFrames_ - latencyFrames(timing); surplus > 0; surplus -= block)
        session.wait(from(0).data(), static_cast<int>(std::min<std::int64_t>(surplus, block)));
    fade_.prepare(sampleRateHz_, limits::channelRampSeconds, 1.0f);
    gap_.prepare(sampleRateHz_, limits::channelRampSeconds, 1.0f);
    last_.fill(0.0f);
    framesToFade_ = -1;
    over_ = false;
    number = 0;
    logged = 0;
    isEnded = false;
    if (music_) music_->reset();
    lastSent_ = {};
    levels_.forget();
    panners_.forget();
}

void Take::Held::forget() noexcept {
    for (HeldControl unplayed; queue.pop(unplayed);) {
    }
    hasFirst = false;
}

bool Take::queueLevel(double gain, int frame) noexcept {
    return levels_.queue.push({session.timeline().framesRendered() + frame, gain, {}});
}

bool Take::queueLaw(PanningLaw law, double exponent, int frame) noexcept {
    return panners_.queue.push({session.timeline().framesRendered() + frame, exponent, law});
}

// A control that the session's full queue refuses stays the first.
template <class Make>
void Take::release(Held& held, std::int64_t until, Make make) noexcept {
    const std::int64_t now = session.timeline().framesRendered();
    while (held.hasFirst || (held.hasFirst = held.queue.pop(held.first))) {
        if (held.first.frame >= until ||
            !session.callback().control(make(held.first), static_cast<int>(held.first.frame - now)))
            return;
        held.hasFirst = false;
    }
}

// Forwards the controls for the next frames of the renderer: an input acts L later, less the renderer's
// latency.
void Take::releaseUntil(int frames) noexcept {
    const auto& time = session.timeline();
    const std::int64_t until = time.framesRendered() + frames - time.inputLatencyFrames() +
                               HapticRenderer::latencyFramesAt(sampleRateHz_);
    release(levels_, until, [](const HeldControl& held) {
        return RenderControl{.kind = RenderControl::Kind::level, .value = static_cast<float>(held.value)};
    });
    PhantomPanner panner;
    release(panners_, until, [&](const HeldControl& held) {
        const auto& settings = order_->settings;
        panner = {settings.layout, held.law, held.value, settings.midi.fieldWidthMetres(),
                  settings.midi.fieldHeightMetres()};
        return RenderControl{.kind = RenderControl::Kind::panner, .panner = &panner};
    });
}

bool Take::send(std::span<const Strip> strips) {
    return sendStrips(lastSent_, strips, [this](const RenderControl& control) {
        return session.submit({control}).error.empty();
    });
}

bool Take::silence(int frame) noexcept {
    const auto& time = session.timeline();
    if (music_) music_->silence(time.nextRenderedFrame(frame), time.nextInputFrame(frame));
    return session.callback().silence(frame);
}

void Take::end() noexcept {
    if (framesToFade_ < 0) framesToFade_ = session.timeline().inputLatencyFrames();
}

void Take::render(int frames, TakeTiming timing, RenderMode mode) noexcept {
    const std::int64_t surplus = session.timeline().outputLatencyFrames() - latencyFrames(timing);
    if (surplus > 0) {
        if (gap_.now() > 0.0f) return play(0, frames, mode, 0.0f);
        skip(static_cast<int>(std::min<std::int64_t>(surplus, frames)));
        return play(0, frames, mode, surplus > frames ? 0.0f : 1.0f);
    }
    const int waits = static_cast<int>(std::clamp<std::int64_t>(-surplus, 0, frames));
    if (waits > 0) standStill(waits);
    if (waits < frames) play(waits, frames - waits, mode);
}

std::array<float*, limits::maxEnchanters> Take::from(int frame) noexcept {
    std::array<float*, limits::maxEnchanters> at{};
    for (std::size_t j = 0; j < out.size(); ++j) at[j] = out[j].data() + frame;
    return at;
}

// The last samples fade to silence, because a step would be felt.
void Take::standStill(int frames) noexcept {
    session.wait(frames);
    for (std::size_t j = 0; j < out.size(); ++j) std::fill_n(out[j].data(), frames, last_[j]);
    gap_.moveTo(0.0f);
    gap_.apply(from(0).data(), session.channels(), frames);
}

void Take::skip(int frames) noexcept {
    releaseUntil(frames);
    session.wait(from(0).data(), frames);
    if (framesToFade_ > 0) framesToFade_ = std::max<std::int64_t>(0, framesToFade_ - frames);
}

void Take::play(int first, int frames, RenderMode mode, float gap) noexcept {
    const auto at = from(first);
    for (int done = 0; done < frames;) {
        const int part = std::min(frames - done, sliceFrames_);
        releaseUntil(part);
        session.render(from(first + done).data(), part, mode);
        done += part;
    }
    fade(first, frames);
    for (std::size_t j = 0; j < out.size(); ++j) last_[j] = at[j][frames - 1];
    gap_.moveTo(gap);
    gap_.apply(at.data(), session.channels(), frames);
}

void Take::fade(int first, int frames) noexcept {
    if (framesToFade_ < 0) return;
    const int kept = static_cast<int>(std::min<std::int64_t>(framesToFade_, frames));
    framesToFade_ -= kept;
    if (kept == frames) return;
    fade_.moveTo(0.0f);
    fade_.apply(from(first + kept).data(), session.channels(), frames - kept);
    over_ = fade_.isResting();
}

} // namespace physvib
