// SPDX-License-Identifier: MIT
// From session time and a panner to onsets and four amplitudes.
#include "Session/BoardOutput.h"
#include <algorithm>

namespace physvib {

BoardOutput::BoardOutput(Session& session, FeltOutput& device, BoardLink& link, const PhantomPanner& panner)
    : told_{*session.told()}
    , device_{device}
    , link_{link}
    , panner_{panner} {
    setGains();
    link_.follow(this);
}

BoardOutput::~BoardOutput() {
    link_.follow(nullptr);
    link_.stopAll();
}

void BoardOutput::feed() {
    if (const FeltMoment felt = device_.felt(FeltReader::board); felt.steadyNs != 0) clock_.add(felt);
    if (clock_.isReady()) {
        takeControls();
        for (CollisionEvent event; told_.events.pop(event);) {
            if (event.course.travelNs > 0 && isPlayable(event)) moving_.emplace_back(event);
            else strike(event);
        }
        takeSteps();
    }
    setGains();
}

// A layout waits for the first event of its time, the others for the moment at which they are felt.
void BoardOutput::takeControls() {
    for (RenderControl control; told_.controls.pop(control);)
        (control.kind == RenderControl::Kind::panner ? layouts_ : others_).push_back(control);
    const std::int64_t now = BoardLink::nowNs();
    const auto waits = std::find_if(others_.begin(), others_.end(), [&](const auto& c) { return clock_.steadyAt(c.timeNs) > now; });
    std::for_each(others_.begin(), waits, [this](const auto& c) { apply(c); });
    others_.erase(others_.begin(), waits);
}

void BoardOutput::apply(const RenderControl& control) {
    const auto channel = static_cast<std::size_t>(control.channel);
    if (control.kind == RenderControl::Kind::stopAll) {
        moving_.clear();
        return link_.stopAll();
    }
    if (channel >= gains_.size()) return;
    if (control.kind == RenderControl::Kind::gain) gains_[channel] = control.value;
    if (control.kind == RenderControl::Kind::mute) muted_[channel] = control.value != 0.0f;
}

// Not before the link would send them: a path of a minute must not fill its queue.
void BoardOutput::takeSteps() {
    const std::int64_t until = BoardLink::nowNs() + BoardLink::sendAheadMs * 1'000'000;
    for (BoardSteps& steps : moving_)
        while (!steps.isOver() && clock_.steadyAt(steps.nextNs()) < until) strike(steps.take());
    std::erase_if(moving_, [](const BoardSteps& steps) { return steps.isOver(); });
}

void BoardOutput::setGains() {
    std::array<double, limits::board::channels> wanted{};
    for (std::size_t j = 0; j < wanted.size(); ++j)
        if (!device_.isSilent() && !muted_[j]) wanted[j] = device_.level() * gains_[j];
    if (wanted == sent_) return;
    sent_ = wanted;
    link_.setGains(wanted);
}

void BoardOutput::strike(const CollisionEvent& event) {
    if (!isPlayable(event)) return; // as the renderer, which counts it
    for (; !layouts_.empty() && layouts_.front().timeNs <= event.timeNs; layouts_.erase(layouts_.begin())) panner_ = layouts_.front().panner;
    PhantomPanner::Gains gains{};
    panner_.gainsAt(event.x, event.y, event.course.spread, gains);
    link_.push({clock_.steadyAt(event.timeNs), boardEventOf(event, {gains[0], gains[1], gains[2], gains[3]})});
}

} // namespace physvib
