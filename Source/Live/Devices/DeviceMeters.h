// SPDX-License-Identifier: MIT
// Measurements of an output (load, missing blocks, levels), and queues for its input and its signals.
#pragma once
#include "Core/EventQueue.h"
#include "Core/Limits.h"
#include "Core/Nonblocking.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Session.h"
#include "Live/Session/Sink.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace physvib {

class LoadMeter {
public:
    struct Load {
        std::uint64_t blocks = 0;
        float last = 0.0f, worst = 0.0f; ///< processing time / duration
    };

    using Clock = std::chrono::steady_clock;
    /// Measures a block of `frames`, whose rendering began at `start` and has just ended. R, wait-free.
    void take(Clock::time_point start, int frames, int sampleRateHz) noexcept {
        const std::chrono::duration<double> taken = Clock::now() - start;
        measured_.last = static_cast<float>(taken.count() * sampleRateHz / frames);
        measured_.worst = std::max(measured_.worst, measured_.last);
        ++measured_.blocks;
        load_.write(measured_);
    }

    /// M.
    Load read() noexcept { return load_.read(); }

private:
    LatestValue<Load> load_;
    Load measured_; // R
};

// Detects that a device has stopped asking for blocks, because some drivers do not report that a device has
// gone.

/// All methods: M.
class DeviceWatch {
public:
    using Clock = std::chrono::steady_clock;

    /// A device that asks for no block during this time counts as gone; the longest block lasts 1.6 s (8192
    /// frames at 5 kHz).
    static constexpr std::chrono::nanoseconds patience{DevicePulse::goneNs};

    /// Whether the device has gone; call about once a second. `blocks`: number the device has asked for so
    /// far. `isIdle`: the device has no reason to ask. If more than `patience` passed since the last call,
    /// the program was paused together with the device, and the watch restarts.
    bool hasGone(Clock::time_point now, std::uint64_t blocks, bool isIdle) noexcept {
        const bool wasAway = now - lookedAt_ > patience;
        if (blocks != blocks_ || isIdle || wasAway) movedAt_ = now;
        blocks_ = blocks;
        lookedAt_ = now;
        return now - movedAt_ > patience;
    }

    /// Counts a loss of the device, and restarts the watch for the device that runs now.
    void lose(Clock::time_point now) noexcept {
        movedAt_ = lookedAt_ = now;
        ++losses_;
    }
    int losses() const noexcept { return losses_; }

private:
    int losses_ = 0;
    std::uint64_t blocks_ = 0;
    Clock::time_point movedAt_, lookedAt_; // zero before the first call
};

// Meter values of the outputs, for the views of plug-in and mixer.

struct ChannelMeters {
    std::array<float, limits::maxEnchanters> peaks{}; ///< 1 = full scale; falling by `meterFallDbPerSecond`
    std::array<bool, limits::maxEnchanters> isConnected{};
    int enchanters = 0;
    int connected = 0;
    float limiterGain = 1.0f;
    float guardGain = 1.0f; ///< of the channel that OutputGuard attenuates most
};

constexpr double meterFallDbPerSecond = 20.0;

/// Up to 256 samples of the mean of all inputs.
struct HeardPiece {
    std::int64_t sessionNs = 0; ///< of the first sample
    int rateHz = 0;
    int count = 0;
    std::array<float, 256> samples;

    std::span<const float> sound() const noexcept {
        return std::span{samples}.first(static_cast<std::size_t>(count));
    }
};

/// One writer, one reader. The capacity is half a megabyte, 2.7 s at 48 kHz.
class InputTap {
public:
    /// Queues the next samples of each input; the first is at session time `sessionNs`. Pieces that find the
    /// queue full are lost; the time of the next piece shows the gap. R, wait-free.
    void take(const float* const* in, int inputs, int frames, std::int64_t sessionNs,
              int rateHz) noexcept PHYSVIB_NONBLOCKING {
        HeardPiece piece;
        piece.rateHz = rateHz;
        for (int done = 0; done < frames; done += piece.count) {
            piece.sessionNs = sessionNs + std::int64_t{1'000'000'000} * done / rateHz;
            piece.count = std::min(frames - done, static_cast<int>(piece.samples.size()));
            for (int i = 0; i < piece.count; ++i)
                piece.samples[static_cast<std::size_t>(i)] = meanOf(in, inputs, done + i);
            pieces_.push(piece);
        }
    }

    /// False if the queue is empty. The reader, wait-free.
    bool next(HeardPiece& piece) noexcept { return pieces_.pop(piece); }

    std::size_t piecesLost() const noexcept { return pieces_.overflows(); } ///< Any thread.

private:
    static float meanOf(const float* const* in, int inputs, int at) noexcept {
        float sum = 0.0f;
        for (int k = 0; k < inputs; ++k) sum += in[k] != nullptr ? in[k][at] : 0.0f;
        return sum / static_cast<float>(inputs);
    }

    EventQueue<HeardPiece, 512> pieces_;
};

// Ring buffer that copies the output signals of a live session from R to meters, scopes and files.

class SignalTap final : public Sink {
public:
    /// `frames`: capacity of each channel. M.
    SignalTap(int channels, int frames)
        : ring_(static_cast<std::size_t>(channels), std::vector<float>(static_cast<std::size_t>(frames)))
        , frames_{static_cast<std::size_t>(frames)}
        , heard_{channels} {}

    int channels() const noexcept { return static_cast<int>(ring_.size()); }

    /// Copies only the first `channels` from now on; the others keep their old samples. Any thread.
    void hear(int channels) noexcept {
        heard_.store(std::clamp(channels, 0, this->channels()), std::memory_order_relaxed);
    }

    void rendered(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override {
        take(block.channels, block.frames);
    }

    /// Frames that find the ring full are lost and counted. R, wait-free.
    void take(const float* const* channels, int frames) noexcept PHYSVIB_NONBLOCKING {
        const std::size_t written = written_.load(std::memory_order_relaxed),
                          wanted = static_cast<std::size_t>(frames),
                          room = frames_ - (written - read_.load(std::memory_order_acquire));
        const Parts parts = partsOf(written, std::min(room, wanted));
        const auto heard = static_cast<std::size_t>(heard_.load(std::memory_order_relaxed));
        for (std::size_t j = 0; j < heard; ++j) {
            std::copy_n(channels[j], parts.first, ring_[j].data() + parts.begin);
            std::copy_n(channels[j] + parts.first, parts.rest, ring_[j].data());
        }
        written_.store(written + parts.first + parts.rest, std::memory_order_release);
        const std::size_t missing = wanted - parts.first - parts.rest;
        lost_.store(lost_.load(std::memory_order_relaxed) + missing, std::memory_order_relaxed);
    }

    /// Calls `use(const float* const* channels, int frames)` with all unread frames, in one or two parts. One
    /// reader.
    template <class Use>
    void read(Use use) {
        const std::size_t read = read_.load(std::memory_order_relaxed);
        const Parts parts = partsOf(read, written_.load(std::memory_order_acquire) - read);
        std::vector<const float*> at(ring_.size());
        for (const auto& [start, size] :
             {std::pair{parts.begin, parts.first}, {std::size_t{0}, parts.rest}}) {
            if (size == 0) continue;
            for (std::size_t j = 0; j < ring_.size(); ++j) at[j] = ring_[j].data() + start;
            use(at.data(), static_cast<int>(size));
        }
        read_.store(read + parts.first + parts.rest, std::memory_order_release);
    }

    std::uint64_t framesLost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
    struct Parts {
        std::size_t begin, first, rest; // `first` frames from `begin` on, `rest` from the ring's start
    };
    Parts partsOf(std::size_t from, std::size_t count) const noexcept {
        const std::size_t begin = from % frames_, first = std::min(count, frames_ - begin);
        return {begin, first, count - first};
    }

    std::vector<std::vector<float>> ring_;
    const std::size_t frames_;
    std::atomic<std::size_t> written_{0}, read_{0}; // frames so far
    std::atomic<int> heard_;
    std::atomic<std::uint64_t> lost_{0};
};

} // namespace physvib
