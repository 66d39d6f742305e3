// SPDX-License-Identifier: MIT
// Audio of the contacts, for loudspeakers or headphones: one channel or left and right beside the actuators'
// channels, sample-synchronous with them.
#pragma once
#include "Core/ControlQueue.h"
#include "Core/HapticRenderer.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/OfflineRender.h"
#include <memory>
#include <vector>

namespace physvib {

/// Has its own renderer: panning, actuator settings and mutes do not affect the audio, and its limiter has
/// the same latency as the actuators'. An impact plays its material's recording if there is one, else its
/// mode.
class ContactAudio {
public:
    /// With one channel the place does not matter; with two, impacts on the left of `field` are louder on the
    /// left channel.
    explicit ContactAudio(std::vector<ContactRecording> recordings, int ears = 1,
                          const PhantomPanner& field = {})
        : recordings_{std::move(recordings)}
        , field_{field}
        , ears_{ears} {}

    int ears() const noexcept { return ears_; } ///< Any thread.

    /// prepare: silence at frame 0. moveTo: another rate and frame, see HapticRenderer::moveTo. Message
    /// thread (M), not while rendering.
    void prepare(int sampleRateHz);
    void moveTo(int sampleRateHz, std::int64_t frame);

    /// Repeats what the actuators' renderer was given. Render thread (R), wait-free.
    void mirror(const CollisionEvent& event) noexcept { events_.push(event); }
    void mirror(const RenderControl& control) noexcept {
        if (control.kind == RenderControl::Kind::stopAll) changes_.push({control.timeNs});
        if (control.kind == RenderControl::Kind::panner && ears_ > 1)
            changes_.push(
                {control.timeNs, control.panner->fieldWidthMetres(), control.panner->fieldHeightMetres()});
    }

    /// As HapticRenderer. R, wait-free.
    void discard(const WaitingEvents& which) noexcept PHYSVIB_NONBLOCKING;

    /// The same frames as the actuators' renderer, after it. R, wait-free.
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
    PannerPool<32> fields_; // that the renderer has not come to; more wait in changes_
    std::vector<ContactRecording> recordings_;
    PhantomPanner field_;
    int ears_;
    ContactSounds contacts_;
    std::unique_ptr<HapticRenderer> renderer_ = std::make_unique<HapticRenderer>();
};

/// The audio of a render; see ContactAudio.
struct ContactAudioRender {
    int sampleRateHz = 48000;
    std::int64_t frames = 0;
    int blockFrames = 1024;
    int ears = 1;
    PhantomPanner field{}; ///< at the start, with two channels
    double levelDb = 0.0;  ///< of an impact at full scale
    RecordedContacts recordings{};
};

/// Renders offline what ContactAudio plays of `events`, of which clips are not heard, and of the actuators'
/// `controls`. Message thread (M) only.
RenderStatus renderContactAudio(std::vector<CollisionEvent> events, std::vector<RenderControl> controls,
                                const ContactAudioRender& heard, const BlockConsumer& consume);

} // namespace physvib
