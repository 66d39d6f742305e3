// SPDX-License-Identifier: MIT
// Splits a moving tone into segments for a board of protocol 2, or into short events for protocol 1. A
// segment approximates the gains of the computer's renderer by a straight line.
//
// A segment is as long as its line stays within half a converter step of those gains: about a millisecond
// near a corner of the layout, where a root is steepest, otherwise up to the maximum. Its phase continues
// that of the segment before, whatever has been learnt of the board's clock meanwhile; the difference is made
// up by a small change of frequency.
#pragma once
#include "Core/BoardEvent.h"
#include "Core/ClockLaw.h"
#include "Core/CollisionEvent.h"
#include "Wire/BoardStrike.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace physvib {

/// Gains of one moving tone at any time, exactly as the computer's renderer has them: it evaluates the
/// panning law at the ends of each tile and interpolates linearly (Core/Voices.h). One thread.
class PathGains {
public:
    using Gains = std::array<double, limits::board::channels>;

    PathGains(const CollisionEvent& event, std::int64_t lifeNs, int sampleRateHz) noexcept
        : event_{event}
        , rate_{static_cast<double>(sampleRateHz)}
        , onset_{FrameClock{sampleRateHz}.at(event.timeNs)}
        , endFrame_{FrameClock{sampleRateHz}.at(event.timeNs + lifeNs).frame - onset_.frame} {}

    /// `seconds` after the onset. `gainsAt(event)` returns the panner's Gains.
    template <class GainsAt>
    Gains at(double seconds, GainsAt& gainsAt) noexcept {
        constexpr std::int64_t tile = limits::tileFrames;
        // frames here count from the onset's frame
        const double frame = std::max(0.0, seconds * rate_ - onset_.leadFrames);
        const std::int64_t offset = onset_.frame % tile;
        const std::int64_t first = (static_cast<std::int64_t>(frame) + offset) / tile * tile - offset;
        enterTile(std::max<std::int64_t>(first, 0), std::min(first + tile, endFrame_), gainsAt);
        const double share =
            end_ > start_ ? (frame - static_cast<double>(start_)) / static_cast<double>(end_ - start_) : 0.0;
        Gains gains;
        for (std::size_t j = 0; j < gains.size(); ++j)
            gains[j] = std::lerp(startGains_[j], endGains_[j], share);
        return gains;
    }

private:
    template <class GainsAt>
    void enterTile(std::int64_t start, std::int64_t end, GainsAt& gainsAt) noexcept {
        if (start == start_) return;
        start_ = start, end_ = end;
        startGains_ = gainsAtFrame(start, gainsAt);
        endGains_ = gainsAtFrame(end, gainsAt);
    }

    template <class GainsAt>
    Gains gainsAtFrame(std::int64_t frame, GainsAt& gainsAt) const noexcept {
        const double ageNs = (static_cast<double>(frame) + onset_.leadFrames) / rate_ * 1e9;
        const double share = std::min(1.0, ageNs / static_cast<double>(event_.course.travelNs));
        return gainsAt(movedAlong(event_, share));
    }

    CollisionEvent event_;
    double rate_;
    FramePosition onset_;
    std::int64_t endFrame_;
    std::int64_t start_ = -1, end_ = 0; // of the current tile
    Gains startGains_{}, endGains_{};
};

/// Estimated position of an event's time on the board's frames.
struct BoardTime {
    double onset = 0.0; ///< frame of the onset, may be fractional
    double framesPerSecond = limits::board::sampleRateHz;

    double secondsAt(std::int64_t frame) const noexcept {
        return (static_cast<double>(frame) - onset) / framesPerSecond;
    }
    /// The first frame that is not earlier than `seconds` after the onset.
    std::int64_t frameAt(double seconds) const noexcept {
        return static_cast<std::int64_t>(std::ceil(onset + seconds * framesPerSecond));
    }
};

/// The segments of one moving tone, one after another. One thread.
class BoardPath {
public:
    using Gains = PathGains::Gains;
    static constexpr int maxFrames = 320;            ///< 40 ms: what is missing if a segment is lost
    static constexpr int minHurriedFrames = 160;     ///< 20 ms: four such tones use two thirds of the line
    static constexpr double tolerance = 0.5 / 127.0; ///< of full scale
    static constexpr double maxSlipTurns = 1.0 / 64; ///< turns that a segment makes up: more would be
                                                     ///< perceptible
    static constexpr double maxJumpSeconds = 0.02; ///< of the clock: after a larger jump a segment starts at
                                                   ///< its proper time instead of the last one's end

    /// For a session that is rendered at `sampleRateHz`.
    BoardPath(const CollisionEvent& event, int sampleRateHz) noexcept
        : event_{event}
        , lifeNs_{boardLifetimeNs(event)}
        , gains_{event, lifeNs_, sampleRateHz} {}

    bool isOver() const noexcept { return nextNs_ >= lifeNs_; }
    std::int64_t onsetNs() const noexcept { return event_.timeNs; }
    std::int64_t endNs() const noexcept { return event_.timeNs + lifeNs_; }
    /// Session time at which the next segment begins.
    std::int64_t nextNs() const noexcept { return event_.timeNs + nextNs_; }

    /// The next segment; nullopt if the tone is over. `gainsAt(event)` returns the panner's Gains.
    /// isHurried: at least minHurriedFrames long, to save line time, even if the line is then less accurate.
    template <class GainsAt>
    std::optional<BoardSegment> next(const BoardTime& time, GainsAt gainsAt,
                                     bool isHurried = false) noexcept {
        isJoined_ = isJoined_ && std::abs(time.secondsAt(joint_.frame) -
                                          static_cast<double>(nextNs_) * 1e-9) < maxJumpSeconds;
        const std::int64_t begin =
            isJoined_ ? joint_.frame : time.frameAt(static_cast<double>(nextNs_) * 1e-9);
        const std::int64_t remaining = time.frameAt(static_cast<double>(lifeNs_) * 1e-9) - begin;
        if (remaining <= 0) return nextNs_ = lifeNs_, std::nullopt;
        const int available = static_cast<int>(std::min<std::int64_t>(remaining, maxFrames));
        for (int k = 0; k < available; ++k) samples_[at(k)] = gains_.at(time.secondsAt(begin + k), gainsAt);
        const double toneSeconds =
            time.secondsAt(begin) + static_cast<double>(event_.course.toneAgeNs) * 1e-9;
        const double level = amplitudeAfter(event_, toneSeconds);
        const int exact = longestChord(available, std::abs(level)),
                  frames = isHurried ? std::max(exact, std::min(available, minHurriedFrames)) : exact;
        isCoarse_ = frames > exact;
        const double turns = event_.frequencyHz * toneSeconds;
        const std::uint32_t phase =
            isJoined_ ? joint_.phase : static_cast<std::uint32_t>(phaseAfter(turns) >> 32);
        const double errorTurns =
            std::clamp(std::remainder(turns - phase * turnUnit, 1.0), -maxSlipTurns, maxSlipTurns);
        BoardSegment segment = makeSegment(frames, level);
        segment.frame = static_cast<std::uint32_t>(begin);
        segment.phase16 = static_cast<std::uint16_t>((phase + 0x8000u) >> 16);
        segment.turn = static_cast<std::uint32_t>(
            std::llround((event_.frequencyHz / time.framesPerSecond + errorTurns / frames) / turnUnit));
        nextJoint_ = {begin + frames, phase + segment.turn * segment.frames,
                      static_cast<std::int64_t>(time.secondsAt(begin + frames) * 1e9)};
        return segment;
    }

    /// True if the last segment is off by more than `tolerance`.
    bool isCoarse() const noexcept { return isCoarse_; }

    /// The last segment was sent: advances to the next.
    void advance() noexcept {
        joint_ = nextJoint_;
        nextNs_ = joint_.ns;
        isJoined_ = hasBegun_ = true;
    }

    /// Before the first segment: continues where `before` has ended, if both are parts of one tone.
    void continueFrom(const BoardPath& before) noexcept {
        const bool isContinuation =
            before.endNs() == onsetNs() && before.event_.frequencyHz == event_.frequencyHz &&
            before.event_.course.toneAgeNs + before.lifeNs_ == event_.course.toneAgeNs;
        if (hasBegun_ || !isContinuation || !before.isOver() || !before.isJoined_) return;
        joint_ = {before.joint_.frame, before.joint_.phase, 0};
        isJoined_ = true;
    }

    /// Skips the time of one segment. The next one starts at its own time, maybe on another clock.
    void skip() noexcept {
        nextNs_ += maxFrames * (1'000'000'000LL / limits::board::sampleRateHz);
        hasBegun_ = true;
        isJoined_ = false;
    }

private:
    static constexpr double turnUnit = 1.0 / 4294967296.0;
    struct Joint {
        std::int64_t frame = 0;
        std::uint32_t phase = 0; // turns / 2^32
        std::int64_t ns = 0;     // since the onset
    };
    static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

    BoardSegment makeSegment(int frames, double level) const noexcept {
        BoardSegment segment;
        segment.frames = static_cast<std::uint16_t>(frames);
        segment.decay16 = boardDecay16(event_.decayPerSecond);
        for (std::size_t j = 0; j < segment.start.size(); ++j) {
            segment.start[j] = boardAmplitude(level * samples_[0][j]);
            segment.end[j] = boardAmplitude(level * samples_[at(frames - 1)][j]);
        }
        return segment;
    }

    /// Largest number of frames, up to `available`, that one straight line approximates.
    int longestChord(int available, double level) const noexcept {
        int fits = 1, fails = available + 1;
        for (int tried = available; fails - fits > 1; tried = (fits + fails) / 2)
            (isChord(tried, level) ? fits : fails) = tried;
        return fits;
    }

    bool isChord(int frames, double level) const noexcept {
        const Gains &first = samples_[0], &last = samples_[at(frames - 1)];
        for (int k = 1; k + 1 < frames; ++k)
            for (std::size_t j = 0; j < first.size(); ++j)
                if (std::abs(first[j] + (last[j] - first[j]) * k / (frames - 1) - samples_[at(k)][j]) *
                        level >
                    tolerance)
                    return false;
        return true;
    }

    CollisionEvent event_;
    std::int64_t lifeNs_, nextNs_ = 0; // nextNs_: since the onset
    PathGains gains_;
    bool hasBegun_ = false, isCoarse_ = false;
    bool isJoined_ = false; // the segment before was sent, and ends at joint_
    Joint joint_, nextJoint_;
    // gains of the frames that the next segment may have
    std::array<Gains, static_cast<std::size_t>(maxFrames)> samples_{};
};

/// Splits a moving tone into short stationary events, in time order, for a board of protocol 1; newer boards
/// play segments (BoardPath). Each event lasts whole milliseconds, as the link counts them, and nearly whole
/// periods, because it begins at phase 0 on the board. Any thread.
class BoardSteps {
public:
    static constexpr int minMs = 20, maxMs = 60; ///< fewer than 50 per second, of 720 on the line

    explicit BoardSteps(const CollisionEvent& event) noexcept
        : event_{event}
        , stepNs_{lengthMs(event.frequencyHz) * 1'000'000LL}
        , endNs_{boardLifetimeNs(event)} {}

    bool isOver() const noexcept { return doneNs_ >= endNs_; }
    std::int64_t nextNs() const noexcept { return event_.timeNs + doneNs_; }

    /// The next event, at the place where the tone is in the middle of it. Not if isOver().
    CollisionEvent next() noexcept {
        const std::int64_t lengthNs = std::min(stepNs_, endNs_ - doneNs_);
        const double middle = static_cast<double>(doneNs_) + 0.5 * static_cast<double>(lengthNs);
        CollisionEvent step =
            movedAlong(event_, std::min(1.0, middle / static_cast<double>(event_.course.travelNs)));
        step.timeNs = nextNs();
        step.durationNs = lengthNs;
        step.course = {.toneAgeNs = event_.course.toneAgeNs + doneNs_};
        doneNs_ += step.durationNs;
        return step;
    }

    /// Length of a step in ms, minMs to maxMs, that is closest to whole periods.
    static int lengthMs(double frequencyHz) noexcept {
        const auto deviation = [=](int ms) { return std::abs(std::remainder(frequencyHz * ms * 1e-3, 1.0)); };
        int best = minMs;
        for (int ms = minMs + 1; ms <= maxMs; ++ms)
            if (deviation(ms) < deviation(best)) best = ms;
        return best;
    }

private:
    CollisionEvent event_;
    std::int64_t stepNs_, endNs_, doneNs_ = 0;
};

} // namespace physvib
