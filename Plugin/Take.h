// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a session from its seed on, with the settings it was made for, until it has played what is owed.
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

/// The part of a plug-in state that the render thread needs. Each scene run carries its own, so it is never
/// played with the settings of another.
struct TakeSettings {
    TransportMode transport = TransportMode::free;
    EnchanterLayout layout;
    MidiTable midi;
};

/// What takes are made of; the next settings have the next number.
struct TakeOrder {
    SessionSetup setup;
    TakeSettings settings;
    std::uint64_t generation = 0;
    double knownAfterSeconds = 0.0; ///< events are known so long after their time: L has room for that
};

/// How a world is stepped, and so its output latency L. Without a world both are the same.
enum class TakeTiming {
    safe, ///< by a thread beside the render call: L has room for a block and for the thread's lateness
    tight ///< in the render call: L is two steps and the limiter's latency, at any block size
};

class Take {
public:
    /// `hasMusic`: samples may come in. Any thread but R.
    Take(std::shared_ptr<const TakeOrder> order, int sampleRateHz, int blockFrames, TakeTiming timing,
         bool hasMusic = false);

    /// From its seed again. Any thread but R, while nobody renders or steps it.
    void rewind(TakeTiming timing);

    /// It is to play by these strips from session time on. False: not all of it found room, to be sent again.
    /// Any thread but R.
    bool send(std::span<const Strip> strips);

    const TakeSettings& settings() const noexcept { return order_->settings; }
    std::uint64_t generation() const noexcept { return order_->generation; }

    /// L with that timing. Any thread.
    std::int64_t latencyFrames(TakeTiming timing) const noexcept {
        return timing == TakeTiming::tight ? tightFrames_ : safeFrames_;
    }

    /// The next frames of every channel of the session, at most a block. While L is shorter than that
    /// timing's, it grows: the session goes on and nothing of it is played; what was to be felt comes so much
    /// later. While it is longer, it shrinks: in silence as well, and what was to be felt meanwhile is not.
    /// R.
    void render(int frames, TakeTiming timing, RenderMode mode) noexcept;

    /// Level, law and exponent at a frame of the coming block, in the order of their frames and at
    /// ControlPace's pace. Kept here until the renderer comes to them, L later, since its own room is small.
    /// False: there is no room. R, wait-free.
    bool holdLevel(double gain, int frame) noexcept;
    bool holdLaw(PanningLaw law, double exponent, int frame) noexcept;

    /// Where music goes that comes in; null: there is none. R.
    MusicDelay* music() noexcept { return music_.get(); }

    /// What happened before that frame of the coming block is not felt any more. False: there is no room, to
    /// be sent again. R, wait-free.
    bool silence(int frame) noexcept;

    /// Plays what is owed and fades then. R.
    void end() noexcept;
    bool isOver() const noexcept { return over_; } ///< R

    Session session;
    std::atomic<int> number{0};       ///< set by R when it starts
    std::uint64_t logged = 0;         ///< events that left the session for the log; guarded as the log is
    std::atomic<bool> isEnded{false}; ///< R lets go of it
    bool isStill = false;             ///< its world could not go on; whoever steps it
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
    static constexpr int slicesPerSecond = 128; // their frames hold 12 of each kind: CallbackInputs has
                                                // places for 16 panners
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

    std::shared_ptr<const TakeOrder> order_;
    int sampleRateHz_, sliceFrames_;
    std::unique_ptr<MusicDelay> music_;
    std::array<SentStrip, limits::maxEnchanters> lastSent_{};
    Held levels_, panners_;
    std::int64_t safeFrames_ = 0, tightFrames_ = 0; // L, by the timing
    std::int64_t owed_ = -1;                        // frames until it fades; -1: it is not ending
    GainRamp fade_, gap_;                           // gap_ is shut while L grows or shrinks
    std::array<float, limits::maxEnchanters> last_{};
    bool over_ = false;
};

} // namespace physvib
