// SPDX-License-Identifier: MIT
// The loop of HapticRenderer::render: a template of whoever gives it events, so it stands in a header.
#pragma once
#include "Core/HapticRenderer.h"

namespace physvib {

template <class Profile>
template <class Source>
void HapticRenderer<Profile>::refill(Source& source) noexcept {
    CollisionEvent event;
    while (!pending_.full() && source.pop(event)) schedule(event);
    if constexpr (requires(RenderControl c) { source.pop(c); }) {
        RenderControl control;
        while (!controls_.full() && source.pop(control)) controls_.push(control.timeNs, control);
    }
}

// Strikes what comes before the next change that needs a cut, and says how many frames lie before it: at the next
// onset as well, unless the bank takes strikes ahead. Taking an event makes room in the pending store for another.
template <class Profile>
template <class Source>
int HapticRenderer<Profile>::strikeAndReach(Source& source, int most) noexcept {
    for (;;) {
        refill(source);
        actOnDue();
        std::int64_t end = nextChange(most);
        if (!pending_.empty() && pending_.nextTime() < silentUntilNs_) {
            pending_.pop();
            continue;
        }
        if (!pending_.empty()) {
            const FramePosition onset = clock_.at(pending_.nextTime());
            if (onset.frame <= position_ || (onset.frame < end && bank_.takesStrikesAhead())) {
                strike(pending_.next(), onset);
                pending_.pop();
                continue;
            }
            end = std::min(end, onset.frame);
        }
        return static_cast<int>(end - position_);
    }
}

template <class Profile>
template <class Source>
void HapticRenderer<Profile>::render(Source& source, float* const* out, int frames) noexcept PHYSVIB_NONBLOCKING {
    if (!isPrepared_) {
        for (int j = 0; j < channels_; ++j) std::fill_n(out[j], frames, 0.0f);
        return;
    }
    const DenormalGuard guard;
    Channels at{};
    std::copy_n(out, channels_, at.begin());
    for (int done = 0; done < frames;) {
        const int part = strikeAndReach(source, frames - done);
        const bool modesSound = bank_.render(at.data(), position_, part), recordingsSound = player_.render(at.data(), position_, part);
        const bool movingSounds = moving_.render(at.data(), position_, part, [this](const CollisionEvent& e, double x, double y) { return driveAt(e, x, y); });
        const bool isSilent = actuators_.process(at.data(), part, !modesSound && !recordingsSound && !movingSounds);
        limiter_.process(at.data(), part, isSilent);
        position_ += part;
        done += part;
        for (int j = 0; j < channels_; ++j) at[static_cast<std::size_t>(j)] += part;
    }
}

} // namespace physvib
