// SPDX-License-Identifier: MIT
// The audible side of every hit: a channel beside the enchanters', or one for each ear, struck on the very
// frames on which they are.
#pragma once
#include "Core/EventQueue.h"
#include "Core/HapticRenderer.h"
#include "Live/Session/ContactSounds.h"
#include <memory>
#include <vector>

namespace physvib {

/// A renderer of its own: neither panning, actuators nor mutes change what is heard, and its limiter has the
/// same latency as the enchanters' one. A hit sounds as its material's recording if there is one, else as its
/// mode.
class HeardContacts {
public:
    /// One ear hears all at one place; of two, the left one hears most of what is on the left of `field`.
    explicit HeardContacts(std::vector<ContactRecording> recordings, int ears = 1,
                           const PhantomPanner& field = {})
        : recordings_{std::move(recordings)}
        , field_{field}
        , ears_{ears} {}

    /// How one ear is set up, also offline.
    static RendererSettings settingsAt(int sampleRateHz);

    int ears() const noexcept { return ears_; } ///< Any thread.

    /// Silence at frame 0; the same at another rate and frame, as HapticRenderer::moveTo. M, not while
    /// rendering.
    void prepare(int sampleRateHz);
    void moveTo(int sampleRateHz, std::int64_t frame);

    /// What the enchanters' renderer was given. R, wait-free.
    void tell(const CollisionEvent& event) noexcept { events_.push(event); }
    void tell(const RenderControl& control) noexcept {
        if (control.kind == RenderControl::Kind::stopAll) changes_.push({control.timeNs});
        if (control.kind == RenderControl::Kind::panner && ears_ > 1)
            changes_.push(
                {control.timeNs, control.panner.fieldWidthMetres(), control.panner.fieldHeightMetres()});
    }

    /// The same frames as the enchanters' renderer, after it. R, wait-free.
    void render(float* const* out, int frames) noexcept PHYSVIB_NONBLOCKING;

    /// Hits, stops and fields that found no room. Any thread.
    std::uint64_t lost() const noexcept { return events_.overflows() + changes_.overflows(); }

private:
    struct Source;
    struct Change {
        std::int64_t timeNs = 0;
        double fieldWidthMetres = 0.0, fieldHeightMetres = 0.0; // of the field; none: a stop
    };
    void setContacts(int sampleRateHz);

    // Both ends are R. The enchanters' renderer takes at most its pending store and what it plays in a block
    // at a time, and all controls that wait in a session at once.
    EventQueue<CollisionEvent, 16384> events_;
    EventQueue<Change, 512> changes_;
    std::vector<ContactRecording> recordings_;
    PhantomPanner field_;
    int ears_;
    ContactSounds contacts_;
    std::unique_ptr<HapticRenderer> renderer_ = std::make_unique<HapticRenderer>();
};

} // namespace physvib
