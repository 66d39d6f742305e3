// SPDX-License-Identifier: MIT
// The template members of HapticRenderer, among them the render loop. Include it where HapticRenderer::render
// is called.
#pragma once
#include "Core/HapticRenderer.h"

namespace physvib {

template <class Source>
void HapticRenderer::refill(Source& source) noexcept {
    while (!pending_.full() && source.pop(pending_.blank())) {
        if (const CollisionEvent& event = pending_.blank(); canPlay(event))
            pending_.pushBlank(event.timeNs);
        else
            ++rejected_;
    }
    if constexpr (requires(RenderControl c) { source.pop(c); }) {
        RenderControl control;
        while (!controls_.full() && source.pop(control)) controls_.push(control.timeNs, control);
    }
}

// Order within a frame: gates that end close first, then controls act, then strikes begin.
template <class Source>
void HapticRenderer::actOnDue(Source& source) noexcept {
    while (bank_.nextGateFrame() <= position_) bank_.closeNextGate();
    for (; !controls_.empty() && clock_.at(controls_.nextTime()).frame <= position_; controls_.pop()) {
        apply(controls_.next());
        if constexpr (requires(const RenderControl& c) { source.done(c); }) source.done(controls_.next());
    }
}

// Strikes the events that are due before the next change that divides the block, and returns how many frames
// can be rendered until then. If the mode bank cannot take strikes ahead of their frame, the next onset
// divides the block as well. After each event the loop refills the store, because popping freed a place; an
// event with a duration adds a gate, so `end` is computed again.
template <class Source>
int HapticRenderer::strikeAndReach(Source& source, int most) noexcept {
    for (;;) {
        refill(source);
        actOnDue(source);
        const std::int64_t end = nextChange(most);
        const bool wasFull = pending_.full();
        for (bool isSame = true; isSame;) {
            if (pending_.empty()) return static_cast<int>(end - position_);
            const FramePosition onset = clock_.at(pending_.nextTime());
            const bool isDue = onset.frame <= position_ || (onset.frame < end && bank_.takesStrikesAhead()),
                       isHeard = !isSilenced(pending_.next());
            if (isHeard && !isDue) return static_cast<int>(std::min(end, onset.frame) - position_);
            isSame = !wasFull && pending_.next().durationNs == 0;
            if (isHeard && strike(pending_.next(), onset))
                if constexpr (requires(const CollisionEvent& e, std::int64_t frame) {
                                  source.struck(e, frame);
                              })
                    source.struck(pending_.next(), std::max(onset.frame, position_));
            pending_.pop();
        }
    }
}

template <class Source>
int HapticRenderer::discard(Source& source, const WaitingEvents& which) noexcept PHYSVIB_NONBLOCKING {
    int count = 0;
    for (int last = -1; last != 0;) { // more than the pending store takes may wait in the source
        refill(source);
        count += last = discardWaiting(which);
    }
    return count;
}

template <class Source>
void HapticRenderer::render(Source& source, float* const* out, int frames) noexcept PHYSVIB_NONBLOCKING {
    if (!isPrepared_) {
        for (int j = 0; j < channels_; ++j) std::fill_n(out[j], frames, 0.0f);
        return;
    }
    const DenormalGuard guard;
    Channels at; // only the first channels_ entries are set
    std::copy_n(out, channels_, at.begin());
    for (int done = 0; done < frames;) {
        const int part = strikeAndReach(source, frames - done);
        const float* const* added = nullptr;
        if constexpr (requires { source.added(position_, part); }) added = source.added(position_, part);
        if (added || !passModes(at, part)) playAll(at, part, added);
        position_ += part;
        done += part;
        for (int j = 0; j < channels_; ++j) at[static_cast<std::size_t>(j)] += part;
    }
}

} // namespace physvib
