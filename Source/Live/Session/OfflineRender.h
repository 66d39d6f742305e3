// SPDX-License-Identifier: MIT
// A whole list of events to samples, as fast as the machine allows: what the live renderer would play,
// without delay.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/HapticRenderer.h"
#include "Live/Session/OnsetMarks.h"
#include <cstdint>
#include <functional>
#include <span>

namespace physvib {

/// How long, and in what pieces; the pieces do not change the samples.
struct OfflineSettings {
    RendererSettings renderer;
    std::int64_t frames = 0;
    int blockFrames = 256;                     ///< 1 to limits::maxBlockFrames
    std::span<const RenderControl> controls{}; ///< in time order
    RecordedContacts contacts{};               ///< from the start
    OnsetMarks* marks = nullptr;               ///< write one channel more
};

/// Takes channels[channel][0..frames), the next frames in order; false stops the render.
using BlockConsumer = std::function<bool(const float* const* channels, int frames)>;

/// Renders frames 0 to settings.frames of `events` (in time order); the limiter's latency is taken out, so
/// that frame n is time n/rate. The renderer's final status. M only, any number at once.
RenderStatus renderOffline(std::span<const CollisionEvent> events, const OfflineSettings& settings,
                           const BlockConsumer& consume);

} // namespace physvib
