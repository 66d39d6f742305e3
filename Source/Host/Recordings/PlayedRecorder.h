// SPDX-License-Identifier: GPL-3.0-or-later
// What a live session plays, to a WAV file: the render role fills a ring, the message thread empties it to disk.
#pragma once
#include "Io/Wav/WavSink.h"
#include "Host/Devices/SignalTap.h"
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

namespace physvib {

/// Every channel of the session, or the first ones, in their own level (before the output's master gain). A file has one rate, so it ends where
/// another comes.
class PlayedRecorder final : public Sink {
public:
    /// Room for `seconds` until drain() is called. M.
    PlayedRecorder(const std::filesystem::path& path, int channels, int sampleRateHz, double seconds = 4.0)
        : sampleRateHz_{sampleRateHz}
        , wav_{path, channels, sampleRateHz}
        , tap_{channels, static_cast<int>(seconds * sampleRateHz)} {}

    /// Empty, or one line with the reason. M.
    const std::string& error() const noexcept { return wav_.error(); }

    int sampleRateHz() const noexcept { return sampleRateHz_; }

    /// R, wait-free. Frames that find no room are lost and counted.
    void rendered(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override {
        if (block.sampleRateHz != sampleRateHz_) isWhole_.store(false, std::memory_order_relaxed);
        if (!isWhole()) return;
        if (firstFrame_.load(std::memory_order_relaxed) < 0) firstFrame_.store(block.sessionFrame, std::memory_order_relaxed);
        tap_.take(block.channels, block.frames);
    }
    bool isWhole() const noexcept { return isWhole_.load(std::memory_order_relaxed); } ///< no other rate has come. Any thread

    /// Says in the file at which session time it begins, by the session's play-out delay L; before the first drain(). M.
    void tellBeginning(std::int64_t playOutFrames) noexcept { playOutFrames_ = playOutFrames; }

    /// Writes what has come. M, often enough.
    void drain();

    /// The last samples, the header, and the file is in its place; empty or one line with the reason. M, after R stopped.
    const std::string& finish();

    std::int64_t firstFrame() const noexcept { return firstFrame_.load(std::memory_order_relaxed); } ///< of the session; -1: nothing yet
    /// What happens at session time t is felt t less this behind the file's first frame; none before tellBeginning() and that frame.
    std::optional<double> beginsSeconds() const noexcept {
        if (!playOutFrames_ || firstFrame() < 0) return {};
        return static_cast<double>(firstFrame() - *playOutFrames_) / sampleRateHz_;
    }
    std::int64_t frames() const noexcept { return written_; }                                       ///< in the file. M
    std::uint64_t framesLost() const noexcept { return tap_.framesLost(); }

private:
    int sampleRateHz_;
    WavSink wav_;
    SignalTap tap_;
    std::atomic<std::int64_t> firstFrame_{-1};
    std::atomic<bool> isWhole_{true};
    std::optional<std::int64_t> playOutFrames_;
    std::int64_t written_ = 0;
};

} // namespace physvib
