// SPDX-License-Identifier: MIT
// Between USB and the output: a queue of frames, the fade over its gaps, the feedback that tells the host how
// fast to send, and the count of missing packets. Main loop writes, the output's interrupt reads; none waits.
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
class DroppedFrames {
public:
    static constexpr std::int32_t fadeFrames = 4 * tileFrames; // 1.3 ms; a power of two: cheap to divide by

    /// Starts a fade: frames are missing after the last one.
    void miss() noexcept {
        held_ = last_;
        left_ = fadeFrames;
    }
    /// Ends the fade: the output is silent.
    void forget() noexcept { left_ = 0; }

    bool isJoining() const noexcept { return left_ > 0; }
    /// Replaces join() while there is no fade.
    void keep(const Frame<channels>& frame) noexcept { last_ = frame; }
    void join(Frame<channels>& frame) noexcept {
        if (left_ > 0) {
            for (std::size_t j = 0; j < frame.size(); ++j) {
                const std::int32_t y = held_[j] * left_ + frame[j] * (fadeFrames - left_);
                frame[j] = static_cast<std::int16_t>(y / fadeFrames);
            }
            --left_;
        }
        last_ = frame;
    }
    const Frame<channels>& last() const noexcept { return last_; } ///< last frame that was sent

private:
    Frame<channels> held_{}, last_{};
    std::int32_t left_ = 0;
};

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
        const auto at = written_.load(std::memory_order_relaxed);
        if (at - read_.load(std::memory_order_acquire) + count > maxFrames) {
            overruns_.store(overruns_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
            miss();
            return;
        }
        for (std::uint32_t k = 0; k < count; ++k) {
            frames_[(at + k) % capacityFrames] = frames[k];
            isBehindGap_[(at + k) % capacityFrames] = isMissing_;
            isMissing_ = false;
        }
        written_.store(at + count, std::memory_order_release);
    }

    /// Marks a gap before the frames of the next write. Main loop.
    void miss() noexcept { isMissing_ = true; }

    /// Reads up to a tile, with fades after gaps; returns the number of frames. Interrupt of the output.
    int read(Tile<channels>& tile, DroppedFrames<channels>& dropped) noexcept {
        const auto at = read_.load(std::memory_order_relaxed);
        const auto count = std::min<std::uint32_t>(level(), tileFrames);
        bool isWhole = !dropped.isJoining();
        for (std::uint32_t k = 0; k < count; ++k) {
            tile[k] = frames_[(at + k) % capacityFrames];
            isWhole = isWhole && !isBehindGap_[(at + k) % capacityFrames];
        }
        if (isWhole && count > 0) // the usual case
            dropped.keep(tile[count - 1]);
        else
            for (std::uint32_t k = 0; k < count; ++k) {
                if (isBehindGap_[(at + k) % capacityFrames]) dropped.miss();
                dropped.join(tile[k]);
            }
        read_.store(at + count, std::memory_order_release);
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
    std::uint32_t writtenFrames() const noexcept {
        return written_.load(std::memory_order_acquire);
    } ///< any thread
    std::uint32_t overruns() const noexcept {
        return overruns_.load(std::memory_order_relaxed);
    } ///< packets dropped; any thread

private:
    std::array<Frame<channels>, capacityFrames> frames_{};
    std::array<bool, capacityFrames> isBehindGap_{};
    bool isMissing_ = false; // writer only
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
            mean_ = 0;
            hasMean_ = false;
            return nominal;
        }
        const auto level = static_cast<std::int32_t>(levelFrames) * 256;
        // Tiles leave in steps of 16 frames, so the level jumps with the phase of packets; the mean does not.
        mean_ = hasMean_ ? mean_ + (level - mean_) / 16 : level;
        hasMean_ = true;
        // A frame too few asks for a 256th of a frame more: 500 ppm move the level by six frames.
        const auto wanted = static_cast<std::int32_t>(targetFrames) * 256 - mean_;
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(nominal) +
                                          std::clamp<std::int32_t>(wanted, -65536, 65536));
    }

private:
    std::int32_t mean_ = 0;
    bool hasMean_ = false;
};

/// Counts lost packets: a host sends one in each numbered millisecond of the bus. Main loop only.
class MissingPackets {
public:
    /// `number`: the bus' count of milliseconds, 11 bits, at a packet. True: packets are missing before it.
    bool see(std::uint32_t number, bool isPlaying) noexcept {
        const std::uint32_t between = (number - last_ - 1) & numbers;
        last_ = number;
        // The same number again: the previous packet was handled late. A stream that starts has no gap.
        if (!isPlaying || between == 0 || between > numbers / 2) return false;
        count_ += between;
        return true;
    }
    std::uint32_t count() const noexcept { return count_; }

private:
    static constexpr std::uint32_t numbers = 0x7ff;
    std::uint32_t last_ = 0, count_ = 0;
};

} // namespace physvib::pico
