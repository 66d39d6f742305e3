// SPDX-License-Identifier: MIT
// Load, losses and levels of an output; queues from the render thread (R) to others (M: message thread).
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

/// Share of real time that rendering takes.
class LoadMeter {
public:
    struct Load {
        std::uint64_t blocks = 0;
        float last = 0.0f, worst = 0.0f; ///< processing time / duration
    };

    using Clock = std::chrono::steady_clock;
    /// Measures a block of `frames`, whose rendering began at `start` and has just ended. R, wait-free.
    void addBlock(Clock::time_point start, int frames, int sampleRateHz) noexcept {
        const std::chrono::duration<double> duration = Clock::now() - start;
        latest_.last = static_cast<float>(duration.count() * sampleRateHz / frames);
        latest_.worst = std::max(latest_.worst, latest_.last);
        ++latest_.blocks;
        load_.write(latest_);
    }

    /// The latest measurements. M.
    Load read() noexcept { return load_.read(); }

private:
    LatestValue<Load> load_;
    Load latest_; // R
};

// Detects that a device has stopped asking for blocks, because some drivers do not report that a device has
// gone.

/// All methods: M.
class DeviceWatch {
public:
    using Clock = std::chrono::steady_clock;

    /// A device that asks for no block during this time counts as gone; the longest block lasts 1.6 s (8192
    /// frames at 5 kHz).
    static constexpr std::chrono::nanoseconds timeOut{DevicePulse::goneAfterNs};

    /// Whether the device has gone; call about once a second. `blocks`: number the device has asked for so
    /// far. `isIdle`: the device has no reason to ask. If more than `timeOut` passed since the last call,
    /// the program was paused together with the device, and the watch restarts.
    bool isGone(Clock::time_point now, std::uint64_t blocks, bool isIdle) noexcept {
        const bool wasPaused = now - checkedAt_ > timeOut;
        if (blocks != blocks_ || isIdle || wasPaused) progressAt_ = now;
        blocks_ = blocks;
        checkedAt_ = now;
        return now - progressAt_ > timeOut;
    }

    /// Counts a loss of the device, and restarts the watch for the device that runs now.
    void countLoss(Clock::time_point now) noexcept {
        progressAt_ = checkedAt_ = now;
        ++losses_;
    }
    int losses() const noexcept { return losses_; }

private:
    int losses_ = 0;
    std::uint64_t blocks_ = 0;
    Clock::time_point progressAt_, checkedAt_; // zero before the first call
};

/// Meter values of the outputs, for the views of plug-in and mixer.
struct ChannelMeters {
    std::array<float, limits::maxActuators> peaks{}; ///< 1 = full scale; falling by `meterFallDbPerSecond`
    std::array<bool, limits::maxActuators> isConnected{};
    int actuatorCount = 0;
    int connectedCount = 0;
    float limiterGain = 1.0f;
    float guardGain = 1.0f; ///< of the channel that OutputGuard attenuates most
};

constexpr double meterFallDbPerSecond = 20.0;

/// Up to 256 samples of the device's input: the mean of all its channels.
struct InputChunk {
    std::int64_t sessionNs = 0; ///< of the first sample
    int rateHz = 0;
    int count = 0;
    std::array<float, 256> samples;

    std::span<const float> usedSamples() const noexcept {
        return std::span{samples}.first(static_cast<std::size_t>(count));
    }
};

/// A queue of input samples, for one writer and one reader. It holds 2.7 s at 48 kHz (half a megabyte).
class InputTap {
public:
    /// Queues the next samples of each input; the first is at session time `sessionNs`. Chunks that find the
    /// queue full are lost; the time of the next chunk shows the gap. R, wait-free.
    void push(const float* const* in, int inputs, int frames, std::int64_t sessionNs,
              int rateHz) noexcept PHYSVIB_NONBLOCKING {
        InputChunk chunk;
        chunk.rateHz = rateHz;
        for (int done = 0; done < frames; done += chunk.count) {
            chunk.sessionNs = sessionNs + std::int64_t{1'000'000'000} * done / rateHz;
            chunk.count = std::min(frames - done, static_cast<int>(chunk.samples.size()));
            for (int i = 0; i < chunk.count; ++i)
                chunk.samples[static_cast<std::size_t>(i)] = inputMean(in, inputs, done + i);
            chunks_.push(chunk);
        }
    }

    /// False if the queue is empty. The reader, wait-free.
    bool next(InputChunk& chunk) noexcept { return chunks_.pop(chunk); }

    std::size_t chunksLost() const noexcept { return chunks_.overflows(); } ///< Any thread.

private:
    static float inputMean(const float* const* in, int inputs, int frame) noexcept {
        float sum = 0.0f;
        for (int k = 0; k < inputs; ++k) sum += in[k] != nullptr ? in[k][frame] : 0.0f;
        return sum / static_cast<float>(inputs);
    }

    EventQueue<InputChunk, 512> chunks_;
};

// Ring buffer that copies the output signals of a live session from R to meters, scopes and files.

class SignalTap final : public Sink {
public:
    /// `frames`: capacity of each channel. M.
    SignalTap(int channels, int frames)
        : ring_(static_cast<std::size_t>(channels), std::vector<float>(static_cast<std::size_t>(frames)))
        , frames_{static_cast<std::size_t>(frames)}
        , activeChannels_{channels} {}

    int channels() const noexcept { return static_cast<int>(ring_.size()); }

    /// Copies only the first `channels` from now on; the others keep their old samples. Any thread.
    void setActiveChannels(int channels) noexcept {
        activeChannels_.store(std::clamp(channels, 0, this->channels()), std::memory_order_relaxed);
    }

    void onBlock(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override {
        push(block.channels, block.frames);
    }

    /// Frames that find the ring full are lost and counted. R, wait-free.
    void push(const float* const* channels, int frames) noexcept PHYSVIB_NONBLOCKING {
        const std::size_t written = framesWritten_.load(std::memory_order_relaxed),
                          requested = static_cast<std::size_t>(frames),
                          freeFrames = frames_ - (written - framesRead_.load(std::memory_order_acquire));
        const Parts parts = splitRange(written, std::min(freeFrames, requested));
        const auto activeChannels = static_cast<std::size_t>(activeChannels_.load(std::memory_order_relaxed));
        for (std::size_t j = 0; j < activeChannels; ++j) {
            std::copy_n(channels[j], parts.first, ring_[j].data() + parts.begin);
            std::copy_n(channels[j] + parts.first, parts.wrapped, ring_[j].data());
        }
        framesWritten_.store(written + parts.first + parts.wrapped, std::memory_order_release);
        const std::size_t missing = requested - parts.first - parts.wrapped;
        framesLost_.store(framesLost_.load(std::memory_order_relaxed) + missing, std::memory_order_relaxed);
    }

    /// Calls `consume(channels, frames)` with all unread frames, in one or two parts. One reader.
    template <class Consume>
    void read(Consume consume) {
        const std::size_t read = framesRead_.load(std::memory_order_relaxed);
        const Parts parts = splitRange(read, framesWritten_.load(std::memory_order_acquire) - read);
        std::vector<const float*> part(ring_.size());
        for (const auto& [start, size] :
             {std::pair{parts.begin, parts.first}, {std::size_t{0}, parts.wrapped}}) {
            if (size == 0) continue;
            for (std::size_t j = 0; j < ring_.size(); ++j) part[j] = ring_[j].data() + start;
            consume(part.data(), static_cast<int>(size));
        }
        framesRead_.store(read + parts.first + parts.wrapped, std::memory_order_release);
    }

    std::uint64_t framesLost() const noexcept { return framesLost_.load(std::memory_order_relaxed); }

private:
    struct Parts {
        std::size_t begin, first, wrapped; // `first` frames from `begin` on, `wrapped` from the ring's start
    };
    Parts splitRange(std::size_t frame, std::size_t count) const noexcept {
        const std::size_t begin = frame % frames_, first = std::min(count, frames_ - begin);
        return {begin, first, count - first};
    }

    std::vector<std::vector<float>> ring_;
    const std::size_t frames_;
    std::atomic<std::size_t> framesWritten_{0}, framesRead_{0}; // frames so far
    std::atomic<int> activeChannels_;
    std::atomic<std::uint64_t> framesLost_{0};
};

} // namespace physvib
