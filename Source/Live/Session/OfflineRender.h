// SPDX-License-Identifier: MIT
// Offline rendering of an event list to the samples that the live renderer would play, without latency; and a
// time limit for the simulation before it.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/HapticRenderer.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/OnsetMarks.h"
#include "Live/Session/System.h"
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace physvib {
/// Renderer, length and inputs of a render; the block size does not change the samples.
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

// Time limit for simulating a scene before its first sample: a user's scene may take hours.

/// A StepWatch that stops once the simulation has used `seconds` more processor time than the simulated time.
/// Processor time is used because a busy machine is not a slow scene. It affects only whether a render is
/// made, not its samples. For the thread that creates it and simulates; must not be moved.
class SimulationTimeLimit {
public:
    static constexpr double defaultSeconds = 4.0; // built-in scenes take a hundredth of real time

    /// Infinity: no limit.
    explicit SimulationTimeLimit(double seconds)
        : allowedSeconds_{seconds} {}

    bool operator()(std::int64_t simulatedNs) {
        simulatedSeconds_ = static_cast<double>(simulatedNs) * 1e-9;
        cpuSeconds_ = threadCpuSeconds() - startSeconds_;
        return cpuSeconds_ <= allowedSeconds_ + simulatedSeconds_;
    }

    /// Empty, or the error that the limit was exceeded.
    std::string error() const {
        if (cpuSeconds_ <= allowedSeconds_ + simulatedSeconds_) return {};
        return "expected a world that is simulated as fast as it lasts, found " +
               fixedNumber(simulatedSeconds_, 2) + " s of it after " + fixedNumber(cpuSeconds_, 1) +
               " s of processor time (--patience waits longer)";
    }

private:
    double allowedSeconds_;
    double simulatedSeconds_ = 0.0, cpuSeconds_ = 0.0;
    double startSeconds_ = threadCpuSeconds();
};

} // namespace physvib
