// SPDX-License-Identifier: MIT
// The only way to samples: collision events in, one channel per enchanter out (the thesis' vibration manager).
//
// Order of one call: events enter the pending store; those that are due are panned and struck on their exact place
// between two frames; the mode bank is summed; the linked limiter has the last word. Work is cut at the tiles of the
// absolute frame grid and at onsets and gate ends, never at block borders: output does not depend on block size.
#pragma once
#include "Core/DenormalGuard.h"
#include "Core/FrameClock.h"
#include "Core/LinkedLimiter.h"
#include "Core/ModeBank.h"
#include "Core/PendingEvents.h"
#include "Core/PhantomPanner.h"
#include <array>
#include <cstdint>

namespace physvib {

/// What a renderer is set up with.
struct RendererSettings {
    int sampleRateHz = 48000; ///< limits::minSampleRateHz to limits::maxSampleRateHz
    PhantomPanner panner;     ///< its number of channels is the renderer's
    bool limiterEnabled = true; ///< off: samples may exceed 1; the latency stays the same
};

/// Counts since prepare, and the state after the last call.
struct RenderStatus {
    std::int64_t framesRendered = 0;
    std::uint64_t played = 0;   ///< events struck
    std::uint64_t late = 0;     ///< of these: after their time, at once
    std::uint64_t rejected = 0; ///< not playable, above half the sample rate, or no gate was free
    std::uint64_t stolen = 0;   ///< modes faded out early to make room
    std::uint64_t nonFinite = 0;
    int liveModes = 0;
    int pending = 0;
    float limiterGain = 1.0f;
};

/// All memory is inside the object (15 MB for the desktop: keep it on the heap).
template <class Profile>
class HapticRenderer {
public:
    /// Silence at frame 0. M, not while rendering.
    void prepare(const RendererSettings& settings) noexcept;

    /// Writes out[channel][0..frames), 1 to limits::maxBlockFrames. `source.pop(CollisionEvent&)` gives events until
    /// it says false; more than the pending store holds stay there, which is right if they come in time order.
    /// R, wait-free.
    template <class Source>
    void render(Source& source, float* const* out, int frames) noexcept;

    /// Frames by which the output lags the event times (the limiter's look-ahead). Any thread after prepare.
    int latencyFrames() const noexcept { return limiter_.latencyFrames(); }

    /// R only.
    RenderStatus status() const noexcept;

private:
    using Channels = std::array<float*, static_cast<std::size_t>(Profile::maxChannels)>;
    template <class Source>
    void refill(Source& source) noexcept;
    void schedule(const CollisionEvent& event) noexcept;
    bool strikeDue() noexcept;
    void strike(const CollisionEvent& event) noexcept;
    int framesUntilChange(int most) const noexcept;

    FrameClock clock_;
    PhantomPanner panner_;
    PhantomPanner::Gains gains_{};
    ModeBank<Profile> bank_;
    LinkedLimiter<Profile> limiter_;
    PendingEvents<Profile::maxPending> pending_;
    std::int64_t position_ = 0;
    std::uint64_t played_ = 0, late_ = 0, rejected_ = 0;
};

template <class Profile>
template <class Source>
void HapticRenderer<Profile>::refill(Source& source) noexcept {
    CollisionEvent event;
    while (!pending_.full() && source.pop(event)) schedule(event);
}

template <class Profile>
template <class Source>
void HapticRenderer<Profile>::render(Source& source, float* const* out, int frames) noexcept {
    const DenormalGuard guard;
    Channels at{};
    for (int j = 0; j < panner_.channels(); ++j) at[static_cast<std::size_t>(j)] = out[j];
    for (int done = 0; done < frames;) {
        do refill(source);
        while (strikeDue());
        const int part = framesUntilChange(frames - done);
        bank_.render(at.data(), position_, part);
        position_ += part;
        done += part;
        for (int j = 0; j < panner_.channels(); ++j) at[static_cast<std::size_t>(j)] += part;
    }
    limiter_.process(out, frames);
}

extern template class HapticRenderer<DesktopProfile>;
extern template class HapticRenderer<BoardProfile>;

} // namespace physvib
