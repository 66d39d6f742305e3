// SPDX-License-Identifier: MIT
// The renderer: collision events in, one channel of samples per actuator out (the thesis' vibration manager).
// All samples are made here.
//
// Order of one call: events enter the pending store; events that are due are panned and struck at their exact
// time between two frames; the mode bank is summed; each channel passes its actuator stage; the linked
// limiter and then the output guard follow. Controls (layout, gains, delays, ceilings, stop) wait for their
// frame in the same way. Work is divided at the tiles of the absolute frame grid and at onsets, gate ends and
// controls, never at block borders: output does not depend on block size, unless blocks are normalised.
#pragma once
#include "Core/Actuators/ActuatorStage.h"
#include "Core/Actuators/DriveMatrices.h"
#include "Core/Actuators/OutputGuard.h"
#include "Core/ClockLaw.h"
#include "Core/EventQueue.h"
#include "Core/Limits.h"
#include "Core/Modes/InstructionSet.h"
#include "Core/Modes/ModeBank.h"
#include "Core/Nonblocking.h"
#include "Core/PhantomPanner.h"
#include "Core/RenderControl.h"
#include "Core/Voices.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib {
/// True if the renderer supports that sample rate. Any thread.
constexpr bool isSampleRate(int hz) noexcept {
    return hz >= limits::minSampleRateHz && hz <= limits::maxSampleRateHz;
}

/// Settings of HapticRenderer::prepare.
struct RendererSettings {
    int sampleRateHz = 48000; ///< see isSampleRate
    int channels = 0; ///< outputs; 0: as many as the panner has actuators. Outputs without an actuator are
                      ///< silent. At most limits::maxActuators
    PhantomPanner panner;       ///< at most `channels` actuators; a control can change it
    bool limiterEnabled = true; ///< off: samples may exceed 1, no OutputGuard acts; the same latency
    std::array<float, limits::maxActuators> ceilings = fullScale(); ///< drive ceiling per channel, > 0
    int modes = 0; ///< modes that sound at once; a further one steals the quietest, which is counted. Memory
                   ///< depends on it. 0, and at most: limits::maxModes
    InstructionSet instructions = InstructionSet::best; ///< one that is not available: scalar
    EqualisedActuators equalised{}; ///< per channel; one without measured figures is not equalised
    DriveMatrices drives{}; ///< matrices against mechanical coupling of the panner's actuators; empty: none.
                            ///< The caller keeps them alive
    bool normalisesBlocks = false; ///< each block of each channel by itself is kept within its ceiling, as
                                   ///< thesis 5.1.3 has it. For limiterEnabled = false

    /** `full` times modes / fullModes, but at least `min`; `full` if modes is 0. Any thread. */ int
    scaledToModes(int full, int fullModes, int min) const noexcept {
        return modes == 0 ? full
                          : std::min(full, std::max(min, static_cast<int>(static_cast<std::int64_t>(full) *
                                                                          modes / fullModes)));
    }
    /// Channels that are rendered.
    int outputs() const noexcept { return channels > 0 ? channels : panner.channels(); }

    /// A ceiling of 1 for each channel.
    static constexpr std::array<float, limits::maxActuators> fullScale() {
        std::array<float, limits::maxActuators> all{};
        all.fill(1.0f);
        return all;
    }
};

/// Counts since prepare, and the state after the last call of render.
struct RenderStatus {
    std::int64_t framesRendered = 0; ///< since prepare
    std::uint64_t played = 0;        ///< events started
    std::uint64_t late = 0;          ///< of these: after their time, started at once
    std::uint64_t rejected = 0;      ///< not playable, above half the sample rate, or without a free gate
    std::uint64_t withoutPart = 0;   ///< of those played: PhantomPanner::lacksPartOf, felt on all by place
    std::uint64_t stolen = 0;        ///< modes faded out early because all slots were used
    std::uint64_t nonFinite = 0;     ///< samples that were not finite and became 0
    std::uint64_t unsent = 0;        ///< played events that the full played queue refused
    int liveModes = 0;               ///< modes that sound
    int pending = 0;                 ///< events whose time has not come
    float limiterGain = 1.0f;        ///< current gain; 1: no reduction
    float guardGain = 1.0f;          ///< lowest gain of the OutputGuard over all channels; 1: no reduction
    std::uint64_t guarded = 0;       ///< how often the guard began to reduce
};

/// Selects waiting events to be discarded: those up to a time, either of no world or of any.
struct WaitingEvents {
    std::int64_t untilNs = 0;    ///< the latest time that belongs, of the events' clock
    bool includesWorlds = false; ///< also events of a physics world's fixtures
    /// Whether an event that is due at timeNs belongs.
    bool contain(const CollisionEvent& event, std::int64_t timeNs) const noexcept {
        return timeNs <= untilNs && (includesWorlds || event.source.fixture < 0);
    }
};

/// Renders events to samples. Memory depends on channels and modes and is allocated in prepare.
class HapticRenderer {
public:
    /// Queue of events that were played, with their frames.
    using PlayedQueue = EventQueue<PlayedEvent, static_cast<std::size_t>(limits::playedQueueSize), true>;

    /// Silence at frame 0. False if the settings are not what RendererSettings allows, with at most
    /// limits::maxActuators outputs, or if memory is lacking. Then, as before the first call, render writes
    /// zeros and accepts no events, and moveTo fails. Message thread (M), not while rendering.
    bool prepare(const RendererSettings& settings) noexcept;

    /// From now on events play these recordings. The caller keeps the list and its samples, at this sample
    /// rate, alive as long as the renderer. prepare and moveTo forget them. M, not while rendering.
    void setContacts(const RecordedContacts& contacts) noexcept;

    /// Continues at another sample rate and frame, e.g. on another device. Modes continue to sound; pending
    /// events and gains stay; moving tones stop and the limiter starts afresh. False, and nothing has
    /// changed, if the rate is outside the limits or the renderer is not prepared. If memory is lacking, also
    /// false, and the renderer is no longer prepared. M, not while rendering.
    bool moveTo(int sampleRateHz, std::int64_t frame) noexcept;

    /// Writes out[channel][0..frames), 1 to limits::maxBlockFrames. `source.pop(CollisionEvent&)` delivers
    /// events until it returns false. Events that the pending store cannot hold stay in the source; they are
    /// in time if the source is in time order. Optional members of the source: `pop(RenderControl&)` delivers
    /// controls the same way, whose panners must stay until `done(const RenderControl&)` is called;
    /// `struck(const CollisionEvent&, std::int64_t frame)` is called for each event that is played, with the
    /// renderer's first frame of it; `added(std::int64_t frame, int frames)` returns samples, one pointer per
    /// channel, that are mixed in (null: none). Render thread (R), wait-free.
    template <class Source>
    void render(Source& source, float* const* out, int frames) noexcept PHYSVIB_NONBLOCKING;

    /// Discards these events, here and in `source`; returns how many they were. R, wait-free.
    template <class Source>
    int discard(Source& source, const WaitingEvents& selection) noexcept PHYSVIB_NONBLOCKING;

    /// Events that have been played, for one reader on another thread.
    PlayedQueue& played() noexcept { return playedQueue_; }

    /// Frames by which the output lags behind the event times (the limiter's look-ahead). Any thread after
    /// prepare.
    int latencyFrames() const noexcept { return limiter_.latencyFrames(); }
    /// latencyFrames() of a renderer at that sample rate. Any thread.
    static int latencyFramesAt(int sampleRateHz) noexcept {
        return LinkedLimiter::latencyFramesAt(sampleRateHz);
    }

    RenderStatus status() const noexcept; ///< R only.

private:
    using Channels = std::array<float*, static_cast<std::size_t>(limits::maxActuators)>;
    template <class Source>
    void refill(Source& source) noexcept;
    static bool areValid(const RendererSettings& settings) noexcept;
    bool canPlay(const CollisionEvent& event) const noexcept {
        return isPlayable(event) && event.frequencyHz < 0.5 * clock_.sampleRateHz();
    }
    template <class Source>
    int startDueEvents(Source& source, int maxFrames) noexcept;
    bool renderModesOnly(const Channels& out, int frames) noexcept;
    void renderAll(const Channels& out, int frames, const float* const* added) noexcept;
    void applyGuard(const Channels& out, int frames, bool isSilent) noexcept;
    void normalise(float* const* out, int frames) const noexcept;
    template <class Source>
    void applyDueControls(Source& source) noexcept;
    void apply(const RenderControl& control) noexcept;
    bool prepareAtRate() noexcept;
    bool allocate() noexcept;
    bool strike(const CollisionEvent& event, FramePosition onset) noexcept;
    bool isSilenced(const CollisionEvent& event) const noexcept;
    int discardPending(const WaitingEvents& selection) noexcept;
    bool strikeStill(const CollisionEvent& event, FramePosition onset, std::int64_t closeFrame) noexcept;
    bool strikeCoupled(Strike strike) noexcept;
    void driveAt(const CollisionEvent& event, double* inPhase, double* quadrature) noexcept;
    bool isCoupled() const noexcept {
        return settings_.drives.isOn() &&
               settings_.drives.channels == static_cast<std::size_t>(panners_.base().channels());
    }
    std::int64_t nextChange(int maxFrames) const noexcept;

    FrameClock clock_;
    PartPanners panners_;
    PhantomPanner::Gains gains_{};
    ModeBank bank_;
    SamplePlayer player_;
    MovingTones moving_;
    ActuatorStage actuators_;
    LinkedLimiter limiter_;
    OutputGuard guard_;
    TimeOrdered<CollisionEvent, limits::maxPending, true> pending_;
    TimeOrdered<RenderControl, limits::maxControls, true> controls_;
    PlayedQueue playedQueue_;
    RendererSettings settings_;
    int channels_ = 1;
    bool isPrepared_ = false;
    bool othersAreModes_ = false; // events without a recording play their mode
    // events before this time are not played; the second: of events that no world produced
    std::int64_t position_ = 0, silentUntilNs_ = INT64_MIN, worldlessSilentUntilNs_ = INT64_MIN;
    std::uint64_t played_ = 0, late_ = 0, rejected_ = 0, withoutPart_ = 0;
};

template <class Source>
void HapticRenderer::refill(Source& source) noexcept {
    while (!pending_.full() && source.pop(pending_.freeItem())) {
        if (const CollisionEvent& event = pending_.freeItem(); canPlay(event))
            pending_.pushFreeItem(event.timeNs);
        else
            ++rejected_;
    }
    if constexpr (requires(RenderControl c) { source.pop(c); }) {
        RenderControl control;
        while (!controls_.full() && source.pop(control)) controls_.push(control.timeNs, control);
    }
}

// Order within a frame: gates that end close first, then controls act, then strikes begin.
template <class Source>
void HapticRenderer::applyDueControls(Source& source) noexcept {
    while (bank_.nextGateFrame() <= position_) bank_.closeNextGate();
    for (; !controls_.empty() && clock_.at(controls_.nextTime()).frame <= position_; controls_.pop()) {
        apply(controls_.next());
        if constexpr (requires(const RenderControl& c) { source.done(c); }) source.done(controls_.next());
    }
}

// Strikes the events that are due before the next change that divides the block, and returns how many frames
// can be rendered until then. If the mode bank cannot take strikes ahead of their frame, the next onset
// divides the block as well. After each event the loop refills the store, because popping freed a place; an
// event with a duration adds a gate, so `end` is computed again.
template <class Source>
int HapticRenderer::startDueEvents(Source& source, int maxFrames) noexcept {
    for (;;) {
        refill(source);
        applyDueControls(source);
        const std::int64_t end = nextChange(maxFrames);
        const bool wasFull = pending_.full();
        for (bool isSame = true; isSame;) {
            if (pending_.empty()) return static_cast<int>(end - position_);
            const FramePosition onset = clock_.at(pending_.nextTime());
            const bool isDue = onset.frame <= position_ || (onset.frame < end && bank_.acceptsStrikesAhead()),
                       isAudible = !isSilenced(pending_.next());
            if (isAudible && !isDue) return static_cast<int>(std::min(end, onset.frame) - position_);
            isSame = !wasFull && pending_.next().durationNs == 0;
            if (isAudible && strike(pending_.next(), onset))
                if constexpr (requires(const CollisionEvent& e, std::int64_t frame) {
                                  source.struck(e, frame);
                              })
                    source.struck(pending_.next(), std::max(onset.frame, position_));
            pending_.pop();
        }
    }
}

template <class Source>
int HapticRenderer::discard(Source& source, const WaitingEvents& selection) noexcept PHYSVIB_NONBLOCKING {
    int count = 0;
    for (int last = -1; last != 0;) { // more than the pending store takes may wait in the source
        refill(source);
        count += last = discardPending(selection);
    }
    return count;
}

template <class Source>
void HapticRenderer::render(Source& source, float* const* out, int frames) noexcept PHYSVIB_NONBLOCKING {
    if (!isPrepared_) {
        for (int j = 0; j < channels_; ++j) std::fill_n(out[j], frames, 0.0f);
        return;
    }
    const DenormalGuard guard;
    Channels outputs; // only the first channels_ entries are set
    std::copy_n(out, channels_, outputs.begin());
    for (int done = 0; done < frames;) {
        const int part = startDueEvents(source, frames - done);
        const float* const* added = nullptr;
        if constexpr (requires { source.added(position_, part); }) added = source.added(position_, part);
        if (added || !renderModesOnly(outputs, part)) renderAll(outputs, part, added);
        position_ += part;
        done += part;
        for (int j = 0; j < channels_; ++j) outputs[static_cast<std::size_t>(j)] += part;
    }
    if (settings_.normalisesBlocks) normalise(out, frames);
}

/// Renders frames 0 to `frames` of a renderer that has just been prepared, in blocks of `blockFrames`. Each
/// block is written to out[channel] and passed to `consume(channels, n)`, the next n frames in order, until
/// it returns false. The limiter's look-ahead is rendered first and dropped, so that frame n is time n/rate.
/// On the thread that owns the renderer.
template <class Source, class Consume>
void renderFromStart(HapticRenderer& renderer, Source& source, float* const* out, int channels,
                     std::int64_t frames, int blockFrames, Consume&& consume) {
    std::array<float*, static_cast<std::size_t>(limits::maxActuators)> samples{};
    const std::int64_t latency = renderer.latencyFrames(), end = frames + latency;
    for (std::int64_t done = 0; done < end;) {
        const int block = static_cast<int>(std::min<std::int64_t>(blockFrames, end - done));
        renderer.render(source, out, block);
        const int dropped = static_cast<int>(std::clamp<std::int64_t>(latency - done, 0, block));
        for (int j = 0; j < channels; ++j) samples[static_cast<std::size_t>(j)] = out[j] + dropped;
        done += block;
        if (block > dropped && !consume(static_cast<const float* const*>(samples.data()), block - dropped))
            break;
    }
}
} // namespace physvib
