// SPDX-License-Identifier: MIT
// Start and resumption of a session, and rendering with the output latency.
#include "Live/Session/Session.h"
#include <new>

namespace physvib {

// The renderer's event source. Realtime: queued events. Non-realtime: this thread holds the world and steps
// it until `endNs`.
struct Session::Source {
    Session& session;
    RenderMode mode;
    FrameClock clock;
    std::int64_t nextFrame, endNs; // nextFrame: of the renderer; endNs: of the block
    bool pop(CollisionEvent& event) noexcept {
        if (!session.callback_.popStrike(event) && !popOfWorld(event)) return false;
        session.channels_.mirror(event);
        return true;
    }
    bool popOfWorld(CollisionEvent& event) noexcept {
        if (mode == RenderMode::offline) return session.world_.popOrStep(event, endNs);
        if (!session.world_.pop(event)) return false;
        session.leastMarginFrames_ =
            std::min(session.leastMarginFrames_, clock.at(event.timeNs).frame - nextFrame);
        return true;
    }
    bool pop(RenderControl& control) noexcept {
        if (!session.callback_.popControl(control) && !session.scheduler_.pop(control)) return false;
        session.channels_.mirror(control);
        return true;
    }
    void done(const RenderControl& control) noexcept { ControlQueue<1>::done(control); }
    void struck(const CollisionEvent& event, std::int64_t frame) noexcept {
        session.channels_.struck(event, frame);
    }
    const float* const* added(std::int64_t frame, int frames) noexcept {
        return session.callback_.added_ ? session.callback_.added_->at(frame, frames) : nullptr;
    }
};

Session::Session(std::shared_ptr<const SessionSetup> setup)
    : order_{std::move(setup)}
    , setup_{*order_}
    , renderer_{std::make_unique<HapticRenderer>()}
    , channels_{setup_}
    , callback_{time_, setup_}
    , world_{order_, time_, pulse_, callback_, sinks_}
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
    const ClockLaw law = lawAt(sampleRateHz, maxBlockFrames);
    // the renderer starts with the first block in which something can be felt
    setTime(law, setup_.direct == Direct::fromStart ? law.outputLatencyFrames() - law.limiterFrames : 0);
    world_.prepare();
    callback_.forget();
    scheduler_.prepare();
    leastMarginFrames_ = noMargin;
}

ClockLaw Session::lawAt(int sampleRateHz, int maxBlockFrames) const {
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
    setTime(lawAt(sampleRateHz, maxBlockFrames), clock.at(time_.nowNs()).frame);
    const auto rendered = std::max<std::int64_t>(0, time_.framesRendered() - time_.outputLatencyFrames() +
                                                        time_.law().limiterFrames);
    if (!renderer_->moveTo(sampleRateHz, rendered)) throw std::bad_alloc{};
    channels_.moveTo(sampleRateHz, rendered, rendered - renderer_->latencyFrames());
    renderer_->setContacts(scheduler_.contactsAt(sampleRateHz)); // sounding recordings stop
}

int Session::advance(const StepWatch& keepGoing) {
    scheduler_.takeDueStops();
    const int steps = setup_.hasWorld ? world_.advance(keepGoing) : 0;
    scheduler_.followLanes();
    return steps;
}

void Session::comeBack(std::int64_t nowNs) noexcept {
    const std::int64_t present = time_.nowNs();
    const bool wasGone = pulse_.comeBack(nowNs, present);
    // Sounding modes continue, since a held note is state.
    const WaitingEvents late{wasGone ? INT64_MAX : present, setup_.areEventsOfCaller()};
    Source source{*this, RenderMode::realtime, FrameClock{time_.law().sampleRateHz}, 0, present};
    pulse_.drop(static_cast<std::uint64_t>(renderer_->discard(source, late)));
    channels_.discard(late);
}

void Session::wait(int frames) noexcept {
    world_.beginBlock(RenderMode::realtime);
    time_.waitFrames(frames);
}

void Session::wait(float* const* unfelt, int frames) noexcept {
    const std::int64_t start = time_.outputLatencyFrames() - renderer_->latencyFrames(),
                       next = time_.framesRendered() - start;
    // the renderer may not have started, or start within these frames
    if (const int rendered = static_cast<int>(std::clamp<std::int64_t>(next + frames, 0, frames));
        rendered > 0) {
        Source source{*this, RenderMode::realtime, FrameClock{time_.law().sampleRateHz},
                      std::max<std::int64_t>(0, next), time_.nowNs()};
        renderer_->render(source, unfelt, rendered);
        channels_.render(unfelt, rendered);
    }
    time_.lengthen(-frames);
}

// The renderer's output lags by the limiter's frames, which are part of the output latency, so it starts
// that much earlier.
void Session::render(float* const* out, int frames, RenderMode mode) noexcept {
    if (!setup_.hasWorld) mode = RenderMode::realtime;
    const bool begins = world_.beginBlock(mode);
    const std::int64_t done = begins ? time_.tellFrames(frames) : 0,
                       start = time_.outputLatencyFrames() - renderer_->latencyFrames();
    const int silent = begins ? static_cast<int>(std::clamp<std::int64_t>(start - done, 0, frames)) : frames;
    std::array<float*, limits::maxEnchanters + 3> rest{};
    for (int j = 0; j < channels_.count(); ++j) {
        std::fill_n(out[j], silent, 0.0f);
        rest[static_cast<std::size_t>(j)] = out[j] + silent;
    }
    if (!begins) return;
    const int left = frames - silent;
    const std::int64_t endNs = time_.sessionNs(done + frames);
    Source source{*this, mode, FrameClock{time_.law().sampleRateHz}, done + silent - start, endNs};
    const auto renderRest = [&] {
        if (left > 0) renderer_->render(source, rest.data(), left);
    };
    if (mode == RenderMode::offline) {
        scheduler_.takeDueStops();
        world_.runOffline(endNs, renderRest);
    } else {
        renderRest();
    }
    if (left > 0) channels_.render(rest.data(), left);
    status_.write({renderer_->status(), endNs, leastMarginFrames_, callback_.refused() + channels_.lost()});
}

} // namespace physvib
