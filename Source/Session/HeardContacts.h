// SPDX-License-Identifier: MIT
// The audible side of every hit: one channel beside the enchanters', struck on the very frames on which they are.
#pragma once
#include "Core/EventQueue.h"
#include "Core/HapticRenderer.h"
#include "Session/ContactSounds.h"
#include <memory>
#include <vector>

namespace physvib {

/// A renderer of its own: neither panning, actuators nor mutes change what is heard, and its limiter has the same latency as
/// the enchanters' one. A hit sounds as its material's recording if there is one, else as its mode.
class HeardContacts {
public:
    explicit HeardContacts(std::vector<ContactRecording> recordings)
        : recordings_{std::move(recordings)} {}

    /// How it is set up, also offline.
    static RendererSettings settingsAt(int sampleRateHz);

    /// Silence at frame 0; the same at another rate and frame, as HapticRenderer::moveTo. M, not while rendering.
    void prepare(int sampleRateHz);
    void moveTo(int sampleRateHz, std::int64_t frame);

    /// What the enchanters' renderer was given. R, wait-free.
    void tell(const CollisionEvent& event) noexcept { events_.push(event); }
    void tell(const RenderControl& control) noexcept {
        if (control.kind == RenderControl::Kind::stopAll) stops_.push(control.timeNs);
    }

    /// The same frames as the enchanters' renderer, after it. R, wait-free.
    void render(float* out, int frames) noexcept PHYSVIB_NONBLOCKING;

    /// Hits and stops that found no room. Any thread.
    std::uint64_t lost() const noexcept { return events_.overflows() + stops_.overflows(); }

private:
    struct Source;
    void setContacts(int sampleRateHz);

    // Both ends are R. The enchanters' renderer takes at most its pending store and what it plays in a block at a time,
    // and all controls that wait in a session at once.
    EventQueue<CollisionEvent, 16384> events_;
    EventQueue<std::int64_t, 512> stops_;
    std::vector<ContactRecording> recordings_;
    ContactSounds contacts_;
    std::unique_ptr<HapticRenderer<DesktopProfile>> renderer_ = std::make_unique<HapticRenderer<DesktopProfile>>();
};

} // namespace physvib
