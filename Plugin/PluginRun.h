// SPDX-License-Identifier: GPL-3.0-or-later
// PluginRun: one run of a session from its seed, with its own settings, until its last inputs were played. R
// is the host's audio thread, L the output latency.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/EventQueue.h"
#include "Live/Session/Session.h"
#include "MidiMap.h"
#include "MusicInput.h"
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace physvib {

/// The part of a plug-in state that the render thread needs. Each run has its own copy, so it is never
/// played with the settings of another run.
struct RenderSettings {
    TransportMode transport = TransportMode::free;
    ActuatorLayout layout;
    MidiTable midi;
};

/// What runs are built from. `generation` increases with each change of the settings.
struct RunSpec {
    SessionSetup setup;
    RenderSettings settings;
    std::uint64_t generation = 0;
    double detectionDelaySeconds = 0.0; ///< from a beat until it is detected, at most; L includes it
};

/// Where the world is stepped, which decides the output latency L. Without a world L is the same for both.
enum class StepTiming {
    safe, ///< on another thread than the render call: L includes a block and that thread's delay
    tight ///< in the render call: L is two steps and the limiter's latency, at any block size
};

class PluginRun {
public:
    /// `hasMusic`: the host may send audio, so a MusicDelay is made for it. Any thread but R.
    PluginRun(std::shared_ptr<const RunSpec> spec, int sampleRateHz, int blockFrames, StepTiming timing,
              bool hasMusic = false);

    /// Makes the run ready to begin again from its seed. Any thread but R, while nobody renders or steps it.
    void rewind(StepTiming timing);

    /// Sends changed strips to the session. False if its queue was full: call again. Any thread but R.
    bool send(std::span<const Strip> strips);

    const RenderSettings& settings() const noexcept { return spec_->settings; }
    std::uint64_t generation() const noexcept { return spec_->generation; }

    /// L with that timing. Any thread.
    std::int64_t latencyFrames(StepTiming timing) const noexcept {
        return timing == StepTiming::tight ? tightFrames_ : safeFrames_;
    }

    /// Renders the next frames of every channel into `samples`, at most a block. If L is shorter than that of
    /// `timing`, a silent pause lengthens it, and pending events come later by that pause. If L is longer,
    /// the surplus is skipped in silence, and the events in it are lost. R.
    void render(int frames, StepTiming timing, RenderMode mode) noexcept;

    /// Sets the level, or law and exponent, from a frame of the next block on. Frames must not decrease, and
    /// calls be no more frequent than ControlPace allows. A control is queued here until the renderer reaches
    /// its frame, L later, because the session's queue is short. False if the queue is full. R, wait-free.
    bool queueLevel(double gain, int frame) noexcept;
    bool queueLaw(PanningLaw law, double exponent, int frame) noexcept;

    /// The delay that accepts audio from the host; null without `hasMusic`. R.
    MusicDelay* musicDelay() noexcept { return music_.get(); }

    /// Mutes what was before that frame of the next block. False: the queue is full, call again. R,
    /// wait-free.
    bool silence(int frame) noexcept;

    /// Lets the run play what its inputs until now cause, L frames, and fade out then. R.
    void end() noexcept;
    bool hasFaded() const noexcept { return hasFaded_; } ///< true once that fade is complete. R

    Session session;
    std::atomic<int> number{0};              ///< from 1, set by R when the run begins to play; 0 until then
    std::uint64_t loggedEventCount = 0;      ///< events that were moved to the log; guarded like the log
    std::atomic<bool> isReleased{false};     ///< true once R no longer uses the run
    std::vector<std::vector<float>> samples; ///< samples of the last render(), [channel][frame]

private:
    std::array<float*, limits::maxActuators> outputsFrom(int frame) noexcept;
    void renderPause(int frames) noexcept;
    struct QueuedControl {
        std::int64_t frame = 0; // in session time
        double value = 0.0;     // level, or exponent
        PanningLaw law{};
    };
    // Room for the controls of the longest L, a block and the steps of a slow world: a fifth of a second.
    using QueuedControls = EventQueue<QueuedControl, 1024>;
    // In a slice at most 12 controls of each kind become due: CallbackInputs has places for 16 panners.
    static constexpr int slicesPerSecond = 128;
    struct PendingControls {
        QueuedControls queue;
        QueuedControl next;
        bool hasNext = false;
        void clear() noexcept {
            do hasNext = queue.pop(next);
            while (hasNext);
        }
    };
    template <class Make>
    void forwardControls(PendingControls& pending, std::int64_t until, Make make) noexcept;
    void forwardControlsUntil(int frames) noexcept;
    void skipSurplus(int frames) noexcept;
    void play(int first, int frames, RenderMode mode, float gateTarget = 1.0f) noexcept;
    void fadeAtEnd(int first, int frames) noexcept;

    std::shared_ptr<const RunSpec> spec_;
    int sampleRateHz_, sliceFrames_;
    std::unique_ptr<MusicDelay> music_;
    std::array<SentStrip, limits::maxActuators> lastSent_{};
    PendingControls queuedLevels_, queuedPanners_;
    std::int64_t safeFrames_ = 0, tightFrames_ = 0; // L, by the timing
    std::int64_t framesUntilFade_ = -1;             // frames until it fades out; -1: it is not ending
    GainRamp fade_, latencyGate_;                   // latencyGate_ is shut while L grows or shrinks
    std::array<float, limits::maxActuators> lastSamples_{};
    bool hasFaded_ = false;
};

} // namespace physvib
