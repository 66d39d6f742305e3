// SPDX-License-Identifier: MIT
// Renderer of the four-channel vibration board: events in, codes of its digital-to-analogue converters out.
// The board's firmware compiles these files; on a computer they are the reference for the board's output.
//
// Order of one block: the modes are summed; events that are due are added; segments of moving tones are
// added; each channel passes its gain; a limiter with one gain for all channels cuts what exceeds full scale
// at once and recovers within limits::limiterReleaseSeconds, so that a phantom stays in place; the guard
// turns down slow signal parts that would only warm a coil; the codes saturate.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Actuators/GuardLaw.h"
#include "Core/BoardEvent.h"
#include "Core/Modes/PhasorBank.h"
#include "Core/Storage.h"
#include <array>
#include <cstdint>
#include <limits>

namespace physvib {

/// Output guard of the four-channel board against slow signals: applies GuardLaw to the converter codes that
/// were sent, once per block.
///
/// It sums codes, not samples, so that the converters' rounding is included. It is the board's only guard, so
/// it uses the bounds of GuardPlace::last. Deciding per block (half a millisecond) costs more than per two
/// blocks, but lets full scale pass unchanged from 31 Hz on, as on a computer; with two blocks it would be 37
/// Hz. Render thread (R) only; prepare: message thread (M).
class BoardGuard {
public:
    static constexpr int channels = PhasorBank::channels;
    using Areas = GuardLaw<channels>::Row;

    /// Resets the sums. M, not while rendering.
    void prepare() noexcept {
        law_.prepare(channels, GuardPlace::last);
        law_.setTile(blockSeconds);
        isActing_ = false;
    }

    /// True if the gain of the next block has to be reduced.
    bool isActing() const noexcept { return isActing_; }
    /// Not inlined: it runs seldom, so a board keeps it out of its fast memory.
    [[gnu::noinline]] void attenuate(PhasorBank::Block& io) const noexcept {
        for (std::size_t j = 0; j < io.size(); ++j) {
            const float step = (law_.endGain(j) - law_.startGain(j)) / PhasorBank::blockFrames;
            float gain = law_.startGain(j);
            for (float& sample : io[j]) sample *= gain += step;
        }
    }

    /// Area of one channel in a block, from the sum of its codes above mid-scale.
    static constexpr float area(int sum) noexcept {
        return static_cast<float>(sum) * (1.0f / (fullScale * limits::board::sampleRateHz));
    }
    /// Adds the areas of a block that was sent, and decides whether to reduce the next one.
    void update(const Areas& areas) noexcept { isActing_ = law_.update(areas); }

    /// Plays the next block unchanged: for a block that is not sent to the actuators.
    void bypassNextBlock() noexcept { isActing_ = false; }

    float gain() const noexcept { return law_.gain(); }                 ///< lowest gain of all channels
    std::uint32_t episodes() const noexcept { return law_.episodes(); } ///< how often it began to act

    static constexpr float fullScale = 127.0f; ///< in steps of the converters
    static constexpr float blockSeconds =
        static_cast<float>(PhasorBank::blockFrames) / limits::board::sampleRateHz;

private:
    GuardLaw<channels> law_;
    bool isActing_ = false;
};

/// Player of moving-tone segments on the four-channel board: segments that are pending or sounding.
///
/// A segment keeps one phasor, as a mode of PhasorBank does, and a start and an end gain per channel, between
/// which gains are interpolated. Segments are summed in order of arrival, so that a computer computes the
/// same bits as the board. All memory is inside the object. Render thread (R) only.
class MovingSegments {
public:
    static constexpr int capacity = limits::board::maxSegments;

    void clear() noexcept { count_ = 0; }
    int count() const noexcept { return count_; }

    /// False if there is no room, or if the segment ends before frame `now`, which is rendered next. A late
    /// segment is played from where it would be by then. `segment` is playable.
    bool add(const BoardSegment& segment, std::uint32_t now) noexcept;

    /// Adds all segments to the block that begins at `frame`; blocks are consecutive. Ended ones are removed.
    void render(std::uint32_t frame, PhasorBank::Block& io) noexcept;

private:
    struct Slot {
        std::uint32_t frame;
        std::uint16_t frames;
        Complex<float> phasor, turn; // phasor: at its first frame, or at the block's if that is later
        std::array<std::int16_t, static_cast<std::size_t>(limits::board::channels)> start, end;
    };
    static void renderSlot(Slot& slot, std::int32_t age, PhasorBank::Block& io) noexcept;

    std::array<Slot, static_cast<std::size_t>(capacity)> slots_{};
    int count_ = 0;
};

/// Counts since prepare, and the state after the last block.
struct BoardStatus {
    std::uint32_t played = 0;  ///< events started, segments accepted
    std::uint32_t late = 0;    ///< of these: after their time. A late event starts at once; a late segment
                               ///< starts at the phase and gain that it has by then
    std::uint32_t dropped = 0; ///< events that are not playable, or that found the pending store full
    std::uint32_t stolen = 0;  ///< modes ended early to make room for another
    int modes = 0;
    int pending = 0;
};

/// Renders the board's output block by block. All memory is inside the object. Render thread (R) only.
class BoardRenderer {
public:
    static constexpr int channels = PhasorBank::channels;
    static constexpr int blockFrames = PhasorBank::blockFrames;
    static constexpr std::uint8_t midScale = 128;
    using Codes = std::array<std::array<std::uint8_t, static_cast<std::size_t>(channels)>,
                             static_cast<std::size_t>(blockFrames)>;
    using Gains = std::array<float, static_cast<std::size_t>(channels)>;

    void prepare() noexcept; ///< Silence at frame 0, all gains 1.

    /// False, and counted as dropped, if the event is not playable or the pending store is full. Events of
    /// one frame keep their order.
    bool schedule(const BoardEvent& event) noexcept;
    bool schedule(const BoardSegment& segment) noexcept;

    /// Gains per channel, reached within limits::channelRampSeconds. Negative ones invert, 0 mutes.
    void setGains(const Gains& gains) noexcept;
    /// Sets the gains without a ramp, while the output is silent; returns the former target gains.
    Gains exchangeGains(const Gains& gains) noexcept;

    /// Ends all modes and segments and discards pending events, from the next block on. The caller fades what
    /// the converters still hold.
    void stopAll() noexcept;

    /// The guard does not act on the next block: for a block that is not sent to the actuators (self-test).
    void bypassNextBlock() noexcept { guard_.bypassNextBlock(); }

    void render(Codes& out) noexcept; ///< Renders the next block.

    /// First frame of the next block.
    std::uint32_t frame() const noexcept { return static_cast<std::uint32_t>(frame_); }
    BoardStatus status() const noexcept;
    const PhasorBank& bank() const noexcept { return bank_; }
    const BoardGuard& guard() const noexcept { return guard_; }

private:
    void startDueEvents(PhasorBank::Block& io) noexcept;
    void limit(PhasorBank::Block& io) noexcept;
    void encode(const PhasorBank::Block& block, Codes& out) noexcept;

    PhasorBank bank_;
    MovingSegments segments_;
    TimeOrdered<BoardEvent, limits::board::maxPending> pending_;
    std::array<GainRamp, static_cast<std::size_t>(channels)> gains_{};
    float linkedGain_ = 1.0f;
    BoardGuard guard_;
    std::int64_t frame_ = 0; // does not wrap, so that pending events keep their order
    static constexpr auto never = std::numeric_limits<std::int64_t>::max();
    std::int64_t nextDue_ = never; // when the first pending event is due: every block compares it
    std::uint32_t played_ = 0, late_ = 0, dropped_ = 0;
};

} // namespace physvib
