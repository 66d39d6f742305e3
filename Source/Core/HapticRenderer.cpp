// SPDX-License-Identifier: MIT
// When events are struck, and how far a part of a block may reach.
#include "Core/HapticRenderer.h"
#include <algorithm>

namespace physvib {

template <class P>
void HapticRenderer<P>::prepare(const RendererSettings& settings) noexcept {
    clock_ = FrameClock{settings.sampleRateHz};
    panner_ = settings.panner;
    bank_.prepare(settings.sampleRateHz, panner_.channels());
    limiter_.prepare(settings.sampleRateHz, panner_.channels(), settings.limiterEnabled);
    pending_.clear();
    position_ = 0;
    played_ = late_ = rejected_ = 0;
}

template <class P>
void HapticRenderer<P>::schedule(const CollisionEvent& event) noexcept {
    if (isPlayable(event) && event.frequencyHz < 0.5 * clock_.sampleRateHz()) pending_.push(event.timeNs, event);
    else ++rejected_;
}

// Closes the gates and strikes the events whose frame is the next one; true if an event was struck, so that the
// pending store has room again. A gate that ends where a strike begins closes first.
template <class P>
bool HapticRenderer<P>::strikeDue() noexcept {
    while (bank_.nextGateFrame() <= position_) bank_.closeNextGate();
    bool struck = false;
    while (!pending_.empty() && clock_.at(pending_.nextTime()).frame <= position_) {
        strike(pending_.next());
        pending_.pop();
        struck = true;
    }
    return struck;
}

template <class P>
void HapticRenderer<P>::strike(const CollisionEvent& event) noexcept {
    FramePosition onset = clock_.at(event.timeNs);
    const std::int64_t delay = position_ - onset.frame;
    if (delay > 0) onset = {position_, 0.0}; // late: the whole vibration, at once
    const std::int64_t end = clock_.at(event.timeNs + event.durationNs).frame + delay;
    panner_.gainsAt(event.x, event.y, gains_);
    const Strike s{event.frequencyHz, event.decayPerSecond, event.amplitude, onset,
                   event.durationNs > 0 ? end : Strike::never};
    const bool taken = bank_.strike(s, gains_.data());
    played_ += taken ? 1 : 0;
    late_ += taken && delay > 0 ? 1 : 0;
    rejected_ += taken ? 0 : 1;
}

template <class P>
int HapticRenderer<P>::framesUntilChange(int most) const noexcept {
    constexpr int tile = P::tileFrames;
    std::int64_t end = std::min(position_ + most, position_ - position_ % tile + tile);
    end = std::min(end, bank_.nextGateFrame());
    if (!pending_.empty()) end = std::min(end, clock_.at(pending_.nextTime()).frame);
    return static_cast<int>(end - position_);
}

template <class P>
RenderStatus HapticRenderer<P>::status() const noexcept {
    return {position_,        played_, late_, rejected_, bank_.stolenModes(), limiter_.nonFiniteSamples(), bank_.liveModes(),
            pending_.size(), limiter_.gain()};
}

template class HapticRenderer<DesktopProfile>;
template class HapticRenderer<BoardProfile>;

} // namespace physvib
