// SPDX-License-Identifier: MIT
// Audio of the contacts for loudspeakers or headphones, one channel or two, in sync with the actuators'
// samples; and RenderedChannels, all channels of a session.
#pragma once
#include "Core/ControlQueue.h"
#include "Core/HapticRenderer.h"
#include "Core/NameNumbers.h"
#include "Core/RenderControl.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/OfflineRender.h"
#include "Live/Session/OnsetMarks.h"
#include "Live/Session/SessionSetup.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <vector>

namespace physvib {
/// Renders impacts for listeners in a renderer of its own with the actuators' latency; their panning,
/// settings and mutes do not apply. An impact plays its material's recording, or its mode if there is none.
class ContactAudio {
public:
    /// With two channels, impacts are panned left to right by their x in `field`; one channel ignores it.
    explicit ContactAudio(std::vector<ContactRecording> recordings, int channels = 1,
                          const PhantomPanner& field = {})
        : recordings_{std::move(recordings)}
        , field_{field}
        , channels_{channels} {}

    int channels() const noexcept { return channels_; } ///< Any thread.

    /// prepare() starts with silence at frame 0; moveTo() continues at another rate and frame, as
    /// HapticRenderer::moveTo. Message thread (M), not while rendering.
    void prepare(int sampleRateHz);
    void moveTo(int sampleRateHz, std::int64_t frame);

    /// Queues what the actuators' renderer has got. Render thread (R), wait-free.
    void mirror(const CollisionEvent& event) noexcept { events_.push(event); }
    void mirror(const RenderControl& control) noexcept {
        if (control.kind == RenderControl::Kind::stopAll) changes_.push({control.timeNs});
        if (control.kind == RenderControl::Kind::panner && channels_ > 1)
            changes_.push(
                {control.timeNs, control.panner->fieldWidthMetres(), control.panner->fieldHeightMetres()});
    }

    /// As HapticRenderer::discard(). R, wait-free.
    void discard(const WaitingEvents& which) noexcept PHYSVIB_NONBLOCKING;

    /// Renders the same frames as the actuators' renderer; call it after that one. R, wait-free.
    void render(float* const* out, int frames) noexcept PHYSVIB_NONBLOCKING;

    /// Impacts, stops and field changes that did not fit the queues. Any thread.
    std::uint64_t lost() const noexcept { return events_.overflows() + changes_.overflows(); }

private:
    struct Source;
    struct Change {
        std::int64_t timeNs = 0;
        double fieldWidthMetres = 0.0, fieldHeightMetres = 0.0; // size of the new field; 0: a stop
    };
    void setContacts(int sampleRateHz);

    // Written and read by R. Capacity: the actuators' renderer accepts at most its pending store and what it
    // plays in a block at a time, and all pending controls of a session at once.
    EventQueue<CollisionEvent, 16384> events_;
    EventQueue<Change, 512> changes_;
    PannerPool<32> fields_; // panners of queued controls; further changes wait in changes_
    std::vector<ContactRecording> recordings_;
    PhantomPanner field_;
    int channels_;
    ContactSounds contacts_;
    std::unique_ptr<HapticRenderer> renderer_ = std::make_unique<HapticRenderer>();
};

/// Settings of renderContactAudio(); see ContactAudio.
struct ContactAudioRender {
    int sampleRateHz = 48000;
    std::int64_t frames = 0;
    int blockFrames = 1024;
    int channels = 1;
    PhantomPanner field{}; ///< at the start, with two channels
    double levelDb = 0.0;  ///< of an impact at full scale
    RecordedContacts recordings{};
};

/// Renders offline what ContactAudio plays of `events` (without clips) and of the actuators' `controls`.
/// Message thread (M) only.
RenderStatus renderContactAudio(std::vector<CollisionEvent> events, std::vector<RenderControl> controls,
                                const ContactAudioRender& settings, const BlockConsumer& consume);

/// The channels that a session renders: those of the actuators (by HapticRenderer), the audio of contacts,
/// and the trigger output.
class RenderedChannels {
public:
    /// Number of channels with the audio of contacts, in sync with the actuators: 0, 1, or left and right.
    int contactAudioChannels() const noexcept { return contactAudio_ ? contactAudio_->channels() : 0; }

    /// Trigger output on the last channel: a pulse per onset, without gains, ceilings and delays. Null: none.
    const OnsetMarks* marks() const noexcept { return marks_.get(); }

    int count() const noexcept { return actuators_ + contactAudioChannels() + (marks_ ? 1 : 0); }

    /// Highest ceiling that the actuator's channel has had while the limiter is on. Any thread.
    float ceiling(int channel) const noexcept {
        return ceilings_[static_cast<std::size_t>(channel)].load(std::memory_order_relaxed);
    }

    /// Bit j: the actuator's channel j is muted, or its gain is 0, as it was set last. Any thread.
    std::uint64_t mutedChannels() const noexcept { return mutedBits_.load(std::memory_order_relaxed); }

private:
    friend class Session;
    friend class Scheduler;

    explicit RenderedChannels(const SessionSetup& setup)
        : actuators_{setup.channels}
        , contactAudio_{setup.contactSound ? std::make_unique<ContactAudio>(
                                                 *setup.contactSound, setup.contactChannels, setup.panner)
                                           : nullptr}
        , marks_{setup.marks ? std::make_unique<OnsetMarks>(*setup.marks) : nullptr} {
        std::ranges::copy(setup.ceilings, ceilings_.begin());
    }

    /// Updates mutedChannels() for a mute or gain. One thread at a time, as raiseCeiling().
    void updateMutes(const RenderControl& control) noexcept {
        lastChanges_.apply(control);
        mutedBits_.store(lastChanges_.mutedChannels(), std::memory_order_relaxed);
    }
    void raiseCeiling(int channel, float ceiling) noexcept {
        if (channel < 0 || channel >= actuators_) return;
        auto& highest = ceilings_[static_cast<std::size_t>(channel)];
        highest = std::max(highest.load(), ceiling);
    }

    /// prepare() starts with silence at that frame; moveTo() continues at another rate, at which the
    /// actuators' renderer is at frame `rendered`. Message thread (M), not while rendering.
    void prepare(int sampleRateHz, std::int64_t firstFrame) {
        if (contactAudio_) contactAudio_->prepare(sampleRateHz);
        if (marks_) marks_->prepare(sampleRateHz, firstFrame);
    }
    void moveTo(int sampleRateHz, std::int64_t rendered, std::int64_t nextFrame) {
        if (contactAudio_) contactAudio_->moveTo(sampleRateHz, rendered);
        if (marks_) marks_->prepare(sampleRateHz, nextFrame);
    }

    /// mirror() passes on what the actuators' renderer was given; markOnset() marks an event that it plays
    /// from `frame` on. Render thread (R), wait-free.
    void mirror(const CollisionEvent& event) noexcept {
        if (contactAudio_ && !isClip(event.sound)) contactAudio_->mirror(event);
    }
    void mirror(const RenderControl& control) noexcept {
        if (contactAudio_) contactAudio_->mirror(control);
    }
    void markOnset(const CollisionEvent& event, std::int64_t frame) noexcept {
        if (marks_) marks_->addOnset(event, frame);
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
    std::array<std::atomic<float>, limits::maxActuators> ceilings_;
    LastChanges lastChanges_; // the scheduler's thread
    std::atomic<std::uint64_t> mutedBits_{0};
};

} // namespace physvib
