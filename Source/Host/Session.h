// SPDX-License-Identifier: GPL-3.0-or-later
// A world that is felt while it moves: simulation, renderer and the time between them.
//
// THE THREADING MODEL, written here and nowhere else.
//
// Roles, each held by one thread at a time (which thread may change):
//   M  the message thread: sets up, edits, reads telemetry. May allocate, lock, wait.
//   D  the driver: calls advance(). M's timer by default, or a thread of its own (SimulationDriver).
//   R  the render role: calls render(). Never allocates, frees, locks, waits or calls the system - but for blocks
//      that the host calls non-realtime, in which it may lock and step the world.
//
// Time. Session time is the number of frames rendered or being rendered, told by R at the start of each block. An
// input received at session time t acts in the world at t; D steps the world up to session time and never beyond, so no input comes too late. An
// event born at world time w is played at w + L (ClockLaw): R lets the renderer's clock run L behind session time.
// The renderer therefore plays event lists as an offline render does, on the same frame grid: the live output is the
// rendered file, L later, to the bit.
//
// The world (simulation, inputs, backlog) is owned through `worldMutex_`: D holds it per call, R per block and only in
// non-realtime blocks; nobody holds it while calling JUCE or a host. Whoever holds it is the producer of the event
// queue; R alone consumes. The first non-realtime block sets `offline_`, which D respects by doing nothing; the first
// realtime block clears it, one atomic store. World time is a step count, so after either change nothing is made twice
// and nothing is missing. A non-realtime block steps the world to its own end, just as D would, so that D has the full
// gap again after the change back.
//
// Stalls. If D comes late, it catches up, at most `maxCatchUpSeconds` a call; what is still missing then is given up:
// the world has stood still for that long (`slippedNs`), its later events are played that much later. Events that
// arrive after their time are played at once and counted by the renderer.
#pragma once
#include "Core/HapticRenderer.h"
#include "Core/LatestValue.h"
#include "Host/ClockLaw.h"
#include "Physics/Simulation.h"
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace physvib {

/// What a session plays, and on what.
struct SessionSetup {
    Scene scene;
    std::uint32_t seed = 1;
    int stepsPerSecond = 100;
    ImpactTiming timing = ImpactTiming::onset;
    ImpactLocation location = ImpactLocation::contact;
    int channels = 4;
    PhantomPanner panner; ///< at most `channels` enchanters
    bool limiterEnabled = true;
    double longestGapSeconds = messageTimerGapSeconds;
};

/// How the host calls render.
enum class RenderMode { realtime, offline };

/// A moment of the session, for people.
struct SessionStatus {
    RenderStatus render;
    std::int64_t sessionNs = 0;
};

class Session {
public:
    static constexpr double maxCatchUpSeconds = 0.5;

    /// M. Throws std::invalid_argument if the scene is not valid.
    explicit Session(const SessionSetup& setup);

    /// Sets L; silence at session time 0. M, while nobody renders or drives.
    void prepare(int sampleRateHz, int maxBlockFrames);

    /// Goes on at another rate and block size: session time and world stay, L is set anew, what rings rings on.
    /// M, while nobody renders.
    void resume(int sampleRateHz, int maxBlockFrames);

    /// L. Any thread after prepare.
    std::int64_t playOutFrames() const noexcept { return law_.playOutFrames(); }

    int channels() const noexcept { return setup_.channels; }

    /// Steps the world up to session time; the number of steps made. D.
    int advance();

    /// Writes out[channel][0..frames). R; wait-free if `mode` is realtime.
    void render(float* const* out, int frames, RenderMode mode) noexcept;

    /// Changes how later events are rendered: acts in the world's time at session time, so it is felt L later, and an
    /// offline render with the same controls is the same to the bit. The time it was given; -1 if the queue is full.
    /// M (or whoever else is the only one to call it).
    std::int64_t post(RenderControl control) noexcept;

    /// What has been played, in the renderer's frames (session frame - L). One reader.
    HapticRenderer<DesktopProfile>::PlayedQueue& played() noexcept { return renderer_->played(); }

    /// Time that was given up after stalls. Any thread.
    std::int64_t slippedNs() const noexcept { return slippedNs_.load(std::memory_order_relaxed); }

    /// Collisions lost in the physics step. M or D.
    std::uint64_t drops();

    /// The newest state. One reader (M).
    SessionStatus status() noexcept { return status_.read(); }

private:
    using Queue = EventQueue<CollisionEvent, 8192>;
    using Controls = EventQueue<RenderControl, 256>;
    struct LiveSource;
    struct OfflineSource;
    void setLaw(int sampleRateHz, int maxBlockFrames);
    void stepWorld();
    void hand(const CollisionEvent& event);
    bool handOver();
    std::int64_t sessionNs(std::int64_t frames) const noexcept;
    void renderBehind(float* const* out, std::int64_t done, int frames, RenderMode mode) noexcept;

    SessionSetup setup_;
    ClockLaw law_;
    std::unique_ptr<HapticRenderer<DesktopProfile>> renderer_;
    Queue queue_;
    Controls controls_;
    std::atomic<std::int64_t> sessionFrames_{0};
    std::atomic<bool> offline_{false};
    std::atomic<std::int64_t> slippedNs_{0};
    LatestValue<SessionStatus> status_;

    std::mutex worldMutex_; // guards what follows
    std::unique_ptr<Simulation> world_;
    std::vector<CollisionEvent> made_; // events that the queue had no room for yet, from handed_ on
    std::size_t handed_ = 0;
};

} // namespace physvib
