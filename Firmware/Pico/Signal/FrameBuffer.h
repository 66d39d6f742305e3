// SPDX-License-Identifier: MIT
// Between USB and the output: a queue of frames, the fade over its gaps, the feedback of the host's rate,
// and the count of missing packets. The main loop writes, the output's interrupt reads.
#pragma once
#include "FixedGuard.h"
#include <algorithm>
#include <atomic>
#include <cstdint>

namespace physvib::pico {

/// Fades, after a gap, from the last frame that was sent to the stream that continues, since a step would be
/// a click. Samples lie between the two, so none is larger than those of the host. Interrupt of the output
/// only.
template <int channels>
class GapCrossfade {
public:
    static constexpr std::int32_t fadeFrames = 4 * tileFrames; // 1.3 ms; a power of two: cheap to divide by

    /// Starts a fade: frames are missing after the last one.
    void markGap() noexcept {
        fadeFrom_ = last_;
        remainingFadeFrames_ = fadeFrames;
    }
    /// Ends the fade: the output is silent.
    void reset() noexcept { remainingFadeFrames_ = 0; }

    bool isFading() const noexcept { return remainingFadeFrames_ > 0; }
    /// Replaces fade() while no fade is active.
    void setLast(const Frame<channels>& frame) noexcept { last_ = frame; }
    void fade(Frame<channels>& frame) noexcept {
        if (remainingFadeFrames_ > 0) {
            for (std::size_t j = 0; j < frame.size(); ++j) {
                const std::int32_t y =
                    fadeFrom_[j] * remainingFadeFrames_ + frame[j] * (fadeFrames - remainingFadeFrames_);
                frame[j] = static_cast<std::int16_t>(y / fadeFrames);
            }
            --remainingFadeFrames_;
        }
        last_ = frame;
    }
    const Frame<channels>& last() const noexcept { return last_; } ///< last frame that was sent

private:
    Frame<channels> fadeFrom_{}, last_{};
    std::int32_t remainingFadeFrames_ = 0;
};

/// Queue of frames with marks for gaps. Neither side waits.
template <int channels>
class FrameBuffer {
public:
    static constexpr std::uint32_t capacityFrames = 512;
    /// Level right after a packet that the feedback keeps, and from which playing starts: one packet may be
    /// lost and the next be late before the buffer runs dry.
    static constexpr std::uint32_t targetFrames = 128;
    /// More than this is latency, not safety: 5 ms.
    static constexpr std::uint32_t maxFrames = 240;

    /// Adds all frames of a packet; if they do not fit, drops and counts the packet. Main loop.
    void write(const Frame<channels>* frames, std::uint32_t count) noexcept {
        const auto writeFrame = written_.load(std::memory_order_relaxed);
        if (writeFrame - read_.load(std::memory_order_acquire) + count > maxFrames) {
            overruns_.store(overruns_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
            markGap();
            return;
        }
        for (std::uint32_t k = 0; k < count; ++k) {
            frames_[(writeFrame + k) % capacityFrames] = frames[k];
            followsGap_[(writeFrame + k) % capacityFrames] = isGapPending_;
            isGapPending_ = false;
        }
        written_.store(writeFrame + count, std::memory_order_release);
    }

    /// Marks a gap before the frames of the next write. Main loop.
    void markGap() noexcept { isGapPending_ = true; }

    /// Reads up to a tile, with fades after gaps; returns the number of frames. Interrupt of the output.
    int read(Tile<channels>& tile, GapCrossfade<channels>& crossfade) noexcept {
        const auto readFrame = read_.load(std::memory_order_relaxed);
        const auto count = std::min<std::uint32_t>(level(), tileFrames);
        bool hasNoFade = !crossfade.isFading();
        for (std::uint32_t k = 0; k < count; ++k) {
            tile[k] = frames_[(readFrame + k) % capacityFrames];
            hasNoFade = hasNoFade && !followsGap_[(readFrame + k) % capacityFrames];
        }
        if (hasNoFade && count > 0) // the common case
            crossfade.setLast(tile[count - 1]);
        else
            for (std::uint32_t k = 0; k < count; ++k) {
                if (followsGap_[(readFrame + k) % capacityFrames]) crossfade.markGap();
                crossfade.fade(tile[k]);
            }
        read_.store(readFrame + count, std::memory_order_release);
        return static_cast<int>(count);
    }
    /// Interrupt.
    void clear() noexcept {
        read_.store(written_.load(std::memory_order_acquire), std::memory_order_release);
    }

    /// Frames that wait. Any thread.
    std::uint32_t level() const noexcept {
        return written_.load(std::memory_order_acquire) - read_.load(std::memory_order_acquire);
    }
    /// Any thread.
    std::uint32_t writtenFrames() const noexcept { return written_.load(std::memory_order_acquire); }
    /// Packets dropped; any thread.
    std::uint32_t overruns() const noexcept { return overruns_.load(std::memory_order_relaxed); }

private:
    std::array<Frame<channels>, capacityFrames> frames_{};
    std::array<bool, capacityFrames> followsGap_{};
    bool isGapPending_ = false; // writer only
    std::atomic<std::uint32_t> written_{0}, read_{0}, overruns_{0};
};

/// Computes the rate requested from the host, in frames per millisecond with 16 binary places, from the level
/// after each packet, so that the buffer keeps its level at the board's clock. Main loop.
class Feedback {
public:
    static constexpr std::uint32_t nominal = (sampleRateHz / 1000) << 16;

    /// The next rate. `isPlaying`: false gives the nominal rate, because the level is then meaningless.
    std::uint32_t next(std::uint32_t levelFrames, std::uint32_t targetFrames, bool isPlaying) noexcept {
        if (!isPlaying) {
            meanLevel_ = 0;
            hasMeanLevel_ = false;
            return nominal;
        }
        const auto level = static_cast<std::int32_t>(levelFrames) * 256;
        // Tiles leave in steps of 16 frames, so the level jumps with the phase of packets; the mean does not.
        meanLevel_ = hasMeanLevel_ ? meanLevel_ + (level - meanLevel_) / 16 : level;
        hasMeanLevel_ = true;
        // A frame too few asks for a 256th of a frame more: 500 ppm move the level by six frames.
        const auto deficit = static_cast<std::int32_t>(targetFrames) * 256 - meanLevel_;
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(nominal) +
                                          std::clamp<std::int32_t>(deficit, -65536, 65536));
    }

private:
    std::int32_t meanLevel_ = 0;
    bool hasMeanLevel_ = false;
};

/// Counts lost packets: a host sends one in each numbered millisecond of the bus. Main loop only.
class MissingPackets {
public:
    /// `number`: the bus' count of milliseconds, 11 bits, at a packet. True: packets are missing before it.
    bool update(std::uint32_t number, bool isPlaying) noexcept {
        const std::uint32_t missed = (number - lastNumber_ - 1) & numberMask;
        lastNumber_ = number;
        // The same number again: the previous packet was handled late. A stream that starts has no gap.
        if (!isPlaying || missed == 0 || missed > numberMask / 2) return false;
        count_ += missed;
        return true;
    }
    std::uint32_t count() const noexcept { return count_; }

private:
    static constexpr std::uint32_t numberMask = 0x7ff;
    std::uint32_t lastNumber_ = 0, count_ = 0;
};

} // namespace physvib::pico
