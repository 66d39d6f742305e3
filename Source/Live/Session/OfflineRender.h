// SPDX-License-Identifier: MIT
// Renders a list of events offline, as fast as possible, to the samples that the live renderer would play,
// without latency.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/HapticRenderer.h"
#include "Live/Session/OnsetMarks.h"
#include <cstdint>
#include <functional>
#include <span>

namespace physvib {

/// Length and block size of a render; the block size does not change the samples.
struct OfflineSettings {
    RendererSettings renderer;
    std::int64_t frames = 0;
    int blockFrames = 256;                     ///< 1 to limits::maxBlockFrames
    std::span<const RenderControl> controls{}; ///< in time order
    RecordedContacts contacts{};               ///< in use from the start
    OnsetMarks* marks = nullptr;               ///< if given, adds a trigger channel
};

/// Receives channels[channel][0..frames), the next frames in order; false stops the render.
using BlockConsumer = std::function<bool(const float* const* channels, int frames)>;

/// Renders frames 0 to settings.frames of `events` (in time order). The limiter's latency is removed, so that
/// frame n is time n/rate. Returns the renderer's final status. Message thread (M) only, any number at once.
RenderStatus renderOffline(std::span<const CollisionEvent> events, const OfflineSettings& settings,
                           const BlockConsumer& consume);

} // namespace physvib
