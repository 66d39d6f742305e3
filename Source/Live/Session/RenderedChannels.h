// SPDX-License-Identifier: MIT
// The channels that a session renders: those of the actuators, then the audio of contacts, then the trigger
// output.
#pragma once
#include "Core/RenderControl.h"
#include "Core/NameNumbers.h"
#include "Live/Session/ContactAudio.h"
#include "Live/Session/OnsetMarks.h"
#include "Live/Session/SessionSetup.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <memory>

namespace physvib {

/// Part of a session; HapticRenderer renders the actuators' own.
class RenderedChannels {
public:
    /// Number of channels with the audio of contacts, in sync with the actuators: 0, 1, or left and right.
    int heard() const noexcept { return contactAudio_ ? contactAudio_->ears() : 0; }

    /// Trigger output on the last channel: a pulse at each onset. Gains, ceilings and delays do not affect
    /// it. Null: none.
    const OnsetMarks* marks() const noexcept { return marks_.get(); }

    int count() const noexcept { return actuators_ + heard() + (marks_ ? 1 : 0); }

    /// Highest ceiling that the actuator's channel has had while the limiter is on. Any thread.
    float ceiling(int channel) const noexcept {
        return ceilings_[static_cast<std::size_t>(channel)].load(std::memory_order_relaxed);
    }

    /// Bit j: the actuator's channel j is muted, or its gain is 0, as it was set last. Any thread.
    std::uint64_t mutedChannels() const noexcept { return muted_.load(std::memory_order_relaxed); }

private:
    friend class Session;
    friend class Scheduler;

    explicit RenderedChannels(const SessionSetup& setup)
        : actuators_{setup.channels}
        , contactAudio_{setup.contactSound
                            ? std::make_unique<ContactAudio>(*setup.contactSound, setup.ears, setup.panner)
                            : nullptr}
        , marks_{setup.marks ? std::make_unique<OnsetMarks>(*setup.marks) : nullptr} {
        std::ranges::copy(setup.ceilings, ceilings_.begin());
    }

    /// One thread at a time, as the next one.
    void note(const RenderControl& control) noexcept {
        last_.take(control);
        muted_.store(last_.mutedChannels(), std::memory_order_relaxed);
    }
    void raiseCeiling(int channel, float to) noexcept {
        if (channel < 0 || channel >= actuators_) return;
        auto& most = ceilings_[static_cast<std::size_t>(channel)];
        most = std::max(most.load(), to);
    }

    /// prepare: silence, beginning with that frame. moveTo: another rate, where the actuators' renderer is at
    /// frame `rendered`. Message thread (M), not while rendering.
    void prepare(int sampleRateHz, std::int64_t firstFrame) {
        if (contactAudio_) contactAudio_->prepare(sampleRateHz);
        if (marks_) marks_->prepare(sampleRateHz, firstFrame);
    }
    void moveTo(int sampleRateHz, std::int64_t rendered, std::int64_t nextFrame) {
        if (contactAudio_) contactAudio_->moveTo(sampleRateHz, rendered);
        if (marks_) marks_->prepare(sampleRateHz, nextFrame);
    }

    /// Repeats what the actuators' renderer was given; struck: what it plays, with its first frame. Render
    /// thread (R), wait-free.
    void mirror(const CollisionEvent& event) noexcept {
        if (contactAudio_ && !isClip(event.sound)) contactAudio_->mirror(event);
    }
    void mirror(const RenderControl& control) noexcept {
        if (contactAudio_) contactAudio_->mirror(control);
    }
    void struck(const CollisionEvent& event, std::int64_t frame) noexcept {
        if (marks_) marks_->strike(event, frame);
    }

    void discard(const WaitingEvents& which) noexcept {
        if (contactAudio_) contactAudio_->discard(which);
    }

    /// The channels after the actuators', rendered after them. R, wait-free.
    void render(float* const* out, int frames) noexcept {
        if (contactAudio_) contactAudio_->render(out + actuators_, frames);
        if (marks_) marks_->render(out[count() - 1], frames);
    }

    std::uint64_t lost() const noexcept { return contactAudio_ ? contactAudio_->lost() : 0; }

    const int actuators_;
    const std::unique_ptr<ContactAudio> contactAudio_;
    const std::unique_ptr<OnsetMarks> marks_;
    std::array<std::atomic<float>, limits::maxEnchanters> ceilings_;
    LastChanges last_; // the scheduler's thread
    std::atomic<std::uint64_t> muted_{0};
};

} // namespace physvib
