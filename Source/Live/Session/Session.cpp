// SPDX-License-Identifier: MIT
// Starts, resumes and renders a session with its output latency.
#include "Live/Session/Session.h"
#include <new>

namespace physvib {

// The renderer's source of events and controls. In real time they are queued; offline, this thread holds the
// world and steps it until `endNs`.
struct Session::Source {
    Session& session;
    RenderMode mode;
    FrameClock clock;
    std::int64_t nextFrame, endNs; // nextFrame: of the renderer; endNs: of the block
    bool pop(CollisionEvent& event) noexcept {
        if (!session.callback_.popStrike(event) && !popFromWorld(event)) return false;
        session.channels_.mirror(event);
        return true;
    }
    bool popFromWorld(CollisionEvent& event) noexcept {
        if (mode == RenderMode::offline) return session.world_.popOrStep(event, endNs);
        if (!session.world_.pop(event)) return false;
        session.minMarginFrames_ =
            std::min(session.minMarginFrames_, clock.at(event.timeNs).frame - nextFrame);
        return true;
    }
    bool pop(RenderControl& control) noexcept {
        if (!session.callback_.popControl(control) && !session.scheduler_.pop(control)) return false;
        session.channels_.mirror(control);
        return true;
    }
    void done(const RenderControl& control) noexcept { ControlQueue<1>::done(control); }
    void struck(const CollisionEvent& event, std::int64_t frame) noexcept {
        session.channels_.markOnset(event, frame);
    }
    const float* const* added(std::int64_t frame, int frames) noexcept {
        return session.callback_.samples_ ? session.callback_.samples_->samplesFrom(frame, frames) : nullptr;
    }
};

Session::Session(std::shared_ptr<const SessionSetup> setup)
    : setupOwner_{std::move(setup)}
    , setup_{*setupOwner_}
    , renderer_{std::make_unique<HapticRenderer>()}
    , channels_{setup_}
    , callback_{time_, setup_}
    , world_{setupOwner_, time_, pulse_, callback_, sinks_}
    , scheduler_{setup_, time_, pulse_, world_, channels_, sinks_} {}

void Session::prepare(int sampleRateHz, int maxBlockFrames) {
    const std::scoped_lock lock{scheduler_.mutex_, world_.mutex_};
    if (!renderer_->prepare({.sampleRateHz = sampleRateHz,
                             .channels = setup_.channels,
                             .panner = setup_.panner,
                             .limiterEnabled = setup_.limiterEnabled,
                             .ceilings = setup_.ceilings,
                             .modes = setup_.modes,
                             .equalised = setup_.equalised,
                             .normalisesBlocks = setup_.normalisesBlocks}))
        throw std::bad_alloc{}; // instead of silence without an error
    renderer_->setContacts(scheduler_.contactsAt(sampleRateHz));
    channels_.prepare(sampleRateHz, -renderer_->latencyFrames());
    const ClockLaw law = makeClockLaw(sampleRateHz, maxBlockFrames);
    // the renderer starts with the first block in which something can be felt
    setTime(law, setup_.direct == Direct::fromStart ? law.outputLatencyFrames() - law.limiterFrames : 0);
    world_.prepare();
    callback_.clear();
    scheduler_.prepare();
    minMarginFrames_ = noMargin;
}

ClockLaw Session::makeClockLaw(int sampleRateHz, int maxBlockFrames) const {
    return {sampleRateHz,
            setup_.hasWorld ? maxBlockFrames : 0,
            setup_.hasWorld ? setup_.stepsPerSecond : 0,
            setup_.longestGapSeconds,
            HapticRenderer::latencyFramesAt(sampleRateHz),
            sinks_.latencySeconds()};
}

void Session::resume(int sampleRateHz, int maxBlockFrames) {
    const std::scoped_lock lock{scheduler_.mutex_, world_.mutex_};
    const FrameClock clock{sampleRateHz};
    world_.resume(clock);
    setTime(makeClockLaw(sampleRateHz, maxBlockFrames), clock.at(time_.nowNs()).frame);
    const auto rendered = std::max<std::int64_t>(0, time_.framesRendered() - time_.outputLatencyFrames() +
                                                        time_.law().limiterFrames);
    if (!renderer_->moveTo(sampleRateHz, rendered)) throw std::bad_alloc{};
    channels_.moveTo(sampleRateHz, rendered, rendered - renderer_->latencyFrames());
    renderer_->setContacts(scheduler_.contactsAt(sampleRateHz)); // sounding recordings stop
}

int Session::advance(const StepWatch& keepGoing) {
    scheduler_.sendDueStops();
    const int steps = setup_.hasWorld ? world_.advance(keepGoing) : 0;
    scheduler_.followLanes();
    return steps;
}

void Session::endPause(std::int64_t nowNs) noexcept {
    const std::int64_t presentNs = time_.nowNs();
    const bool wasGone = pulse_.endPause(nowNs, presentNs);
    // Sounding modes continue, since a held note is state.
    const WaitingEvents lateEvents{wasGone ? INT64_MAX : presentNs, setup_.hasCallerEvents()};
    Source source{*this, RenderMode::realtime, FrameClock{time_.law().sampleRateHz}, 0, presentNs};
    pulse_.drop(static_cast<std::uint64_t>(renderer_->discard(source, lateEvents)));
    channels_.discard(lateEvents);
}

void Session::lengthenLatency(int frames) noexcept {
    world_.beginBlock(RenderMode::realtime);
    time_.lengthenByBlock(frames);
}

void Session::shortenLatency(float* const* discarded, int frames) noexcept {
    const std::int64_t startFrame = time_.outputLatencyFrames() - renderer_->latencyFrames(),
                       next = time_.framesRendered() - startFrame;
    // the renderer may not have started, or start within these frames
    if (const int rendered = static_cast<int>(std::clamp<std::int64_t>(next + frames, 0, frames));
        rendered > 0) {
        Source source{*this, RenderMode::realtime, FrameClock{time_.law().sampleRateHz},
                      std::max<std::int64_t>(0, next), time_.nowNs()};
        renderer_->render(source, discarded, rendered);
        channels_.render(discarded, rendered);
    }
    time_.lengthen(-frames);
}

// Renders a block: silence until the output latency has passed, then the renderer's frames. The limiter's
// delay is part of that latency, so the renderer starts that much earlier.
void Session::render(float* const* out, int frames, RenderMode mode) noexcept {
    if (!setup_.hasWorld) mode = RenderMode::realtime;
    const bool hasWorldStarted = world_.beginBlock(mode);
    const std::int64_t framesBefore = hasWorldStarted ? time_.advanceFrames(frames) : 0,
                       startFrame = time_.outputLatencyFrames() - renderer_->latencyFrames();
    const int silentFrames =
        hasWorldStarted ? static_cast<int>(std::clamp<std::int64_t>(startFrame - framesBefore, 0, frames))
                        : frames;
    std::array<float*, limits::maxActuators + 3> remaining{};
    for (int j = 0; j < channels_.count(); ++j) {
        std::fill_n(out[j], silentFrames, 0.0f);
        remaining[static_cast<std::size_t>(j)] = out[j] + silentFrames;
    }
    if (!hasWorldStarted) return;
    const int remainingFrames = frames - silentFrames;
    const std::int64_t endNs = time_.sessionNs(framesBefore + frames);
    Source source{*this, mode, FrameClock{time_.law().sampleRateHz}, framesBefore + silentFrames - startFrame,
                  endNs};
    const auto renderRemaining = [&] {
        if (remainingFrames > 0) renderer_->render(source, remaining.data(), remainingFrames);
    };
    if (mode == RenderMode::offline) {
        scheduler_.sendDueStops();
        world_.runOffline(endNs, renderRemaining);
    } else {
        renderRemaining();
    }
    if (remainingFrames > 0) channels_.render(remaining.data(), remainingFrames);
    status_.write({renderer_->status(), endNs, minMarginFrames_, callback_.refused() + channels_.lost()});
}

} // namespace physvib
