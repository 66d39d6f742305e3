// SPDX-License-Identifier: GPL-3.0-or-later
// A take: one run of a session from its seed, with settings of its own, until the last inputs were played.
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

/// The part of a plug-in state that the render thread needs. Each take has its own copy, so it is never
/// played with the settings of another take.
struct TakeSettings {
    TransportMode transport = TransportMode::free;
    EnchanterLayout layout;
    MidiTable midi;
};

/// What takes are made from. `generation` rises with each change of it.
struct TakeSpec {
    SessionSetup setup;
    TakeSettings settings;
    std::uint64_t generation = 0;
    double knownAfterSeconds = 0.0; ///< delay from an event until it is known; L includes it
};

/// Where the world is stepped, which decides the output latency L. Without a world L is the same for both.
enum class TakeTiming {
    safe, ///< on another thread than the render call: L includes a block and that thread's delay
    tight ///< in the render call: L is two steps and the limiter's latency, at any block size
};

class Take {
public:
    /// `hasMusic`: the host may send audio, so a MusicDelay is made for it. Any thread but R.
    Take(std::shared_ptr<const TakeSpec> order, int sampleRateHz, int blockFrames, TakeTiming timing,
         bool hasMusic = false);

    /// Starts again from the seed. Any thread but R, while nobody renders or steps it.
    void rewind(TakeTiming timing);

    /// The session's strips from now on. False: its queue was full; call again. Any thread but R.
    bool send(std::span<const Strip> strips);

    const TakeSettings& settings() const noexcept { return order_->settings; }
    std::uint64_t generation() const noexcept { return order_->generation; }

    /// L with that timing. Any thread.
    std::int64_t latencyFrames(TakeTiming timing) const noexcept {
        return timing == TakeTiming::tight ? tightFrames_ : safeFrames_;
    }

    /// Renders the next frames of every channel, at most a block. If L is shorter than that of `timing`, it
    /// is lengthened in silence: what is still to be felt comes later by as much. If L is longer, it is
    /// shortened in silence too: what was to be felt in the skipped time is lost. R.
    void render(int frames, TakeTiming timing, RenderMode mode) noexcept;

    /// Sets the level, or law and exponent, from a frame of the next block on. Calls are in the order of
    /// their frames, and no more frequent than ControlPace allows. They wait here until the renderer reaches
    /// that frame, L later, because the session's queue is short. False: the queue is full. R, wait-free.
    bool queueLevel(double gain, int frame) noexcept;
    bool queueLaw(PanningLaw law, double exponent, int frame) noexcept;

    /// Takes audio from the host; null without `hasMusic`. R.
    MusicDelay* music() noexcept { return music_.get(); }

    /// Silences all before that frame of the next block. False: the queue is full; call again. R, wait-free.
    bool silence(int frame) noexcept;

    /// Plays what the inputs until now cause, then fades out. R.
    void end() noexcept;
    bool isOver() const noexcept { return over_; } ///< R

    Session session;
    std::atomic<int> number{0};       ///< set by R when it starts
    std::uint64_t logged = 0;         ///< events that were moved to the log; guarded like the log
    std::atomic<bool> isEnded{false}; ///< R no longer uses it
    bool isStill = false;             ///< its world failed and is not stepped again; for the stepping thread
    std::vector<std::vector<float>> out;

private:
    std::array<float*, limits::maxEnchanters> from(int frame) noexcept;
    void standStill(int frames) noexcept;
    struct HeldControl {
        std::int64_t frame = 0; // of the session
        double value = 0.0;     // level, or exponent
        PanningLaw law{};
    };
    // The longest L is a block and the steps of a slow world: a fifth of a second.
    using HeldControls = EventQueue<HeldControl, 1024>;
    // A slice has at most 12 held controls of each kind: CallbackInputs has places for 16 panners.
    static constexpr int slicesPerSecond = 128;
    struct Held {
        HeldControls queue;
        HeldControl first;
        bool hasFirst = false;
        void forget() noexcept;
    };
    template <class Make>
    void release(Held& held, std::int64_t until, Make make) noexcept;
    void releaseUntil(int frames) noexcept;
    void skip(int frames) noexcept;
    void play(int first, int frames, RenderMode mode, float gap = 1.0f) noexcept;
    void fade(int first, int frames) noexcept;

    std::shared_ptr<const TakeSpec> order_;
    int sampleRateHz_, sliceFrames_;
    std::unique_ptr<MusicDelay> music_;
    std::array<SentStrip, limits::maxEnchanters> lastSent_{};
    Held levels_, panners_;
    std::int64_t safeFrames_ = 0, tightFrames_ = 0; // L, by the timing
    std::int64_t framesToFade_ = -1;                // frames until it fades out; -1: it is not ending
    GainRamp fade_, gap_;                           // gap_ is shut while L grows or shrinks
    std::array<float, limits::maxEnchanters> last_{};
    bool over_ = false;
};

} // namespace physvib
