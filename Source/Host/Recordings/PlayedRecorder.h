// SPDX-License-Identifier: GPL-3.0-or-later
// What a live session plays, to a WAV file: the render role fills a ring, a thread empties it to disk.
#pragma once
#include "Host/Devices/SignalTap.h"
#include "Io/Text/NumberText.h"
#include "Io/Wav/WavSink.h"
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace physvib {

/// Every channel of the session, or the first ones, in their own level (before the output's master gain). A
/// file has one rate, so it ends where another comes. From its first samples on it is in its place, a whole
/// WAV of all but the last half second, whatever ends the program or fills the disk; nobody waits for the
/// disk but finish().
class PlayedRecorder final : public Sink {
public:
    /// Room for `seconds` that the disk is late. M.
    PlayedRecorder(const std::filesystem::path& path, int channels, int sampleRateHz, double seconds = 4.0)
        : sampleRateHz_{sampleRateHz}
        , tap_{channels, static_cast<int>(seconds * sampleRateHz)}
        , wav_{path, channels, sampleRateHz}
        , error_{wav_.error()} {
        if (error_.empty()) thread_ = std::thread{[this] { run(); }};
    }
    ~PlayedRecorder() override { end(); }

    /// Empty, or one line with the reason. M.
    std::string error() const {
        const std::lock_guard lock{mutex_};
        return error_;
    }

    int sampleRateHz() const noexcept { return sampleRateHz_; }

    /// R, wait-free. Frames that find no room are lost and counted.
    void rendered(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override {
        if (block.sampleRateHz != sampleRateHz_) isWhole_.store(false, std::memory_order_relaxed);
        if (!isWhole()) return;
        if (firstFrame_.load(std::memory_order_relaxed) < 0)
            firstFrame_.store(block.sessionFrame, std::memory_order_relaxed);
        tap_.take(block.channels, block.frames);
    }
    /// no other rate has come. Any thread
    bool isWhole() const noexcept { return isWhole_.load(std::memory_order_relaxed); }

    /// Says in the file at which session time it begins, by the session's play-out delay L; before the first
    /// frame. M.
    void tellBeginning(std::int64_t playOutFrames) noexcept { playOutFrames_ = playOutFrames; }

    /// The last samples and the header; empty or one line with the reason. M, after R stopped.
    std::string finish() {
        end();
        write();
        return wav_.finish();
    }

    /// of the session; -1: nothing yet
    std::int64_t firstFrame() const noexcept { return firstFrame_.load(std::memory_order_relaxed); }
    /// What happens at session time t is felt t less this behind the file's first frame; none before
    /// tellBeginning() and that frame.
    std::optional<double> beginsSeconds() const noexcept {
        if (playOutFrames_ < 0 || firstFrame() < 0) return {};
        return static_cast<double>(firstFrame() - playOutFrames_) / sampleRateHz_;
    }
    std::int64_t frames() const noexcept { return written_; } ///< that the file has got. M
    std::uint64_t framesLost() const noexcept { return tap_.framesLost(); }

private:
    static constexpr std::chrono::milliseconds period{200}; // with the disk's own time, less than what a kill
                                                            // may cost

    void run() {
        std::unique_lock lock{mutex_};
        while (!ends_.wait_for(lock, period, [this] { return isEnding_; })) {
            lock.unlock();
            write();
            lock.lock();
            error_ = wav_.error();
        }
    }
    void write() {
        const std::int64_t before = written_;
        tap_.read([this](const float* const* channels, int frames) {
            if (const auto begins = beginsSeconds(); begins && written_ == 0)
                wav_.setComment("begins at session time " + fixedNumber(*begins, 6) + " s");
            if (wav_.write(channels, frames)) written_ += frames;
        });
        if (written_ > before) wav_.show();
    }
    void end() {
        if (!thread_.joinable()) return;
        {
            const std::lock_guard lock{mutex_};
            isEnding_ = true;
        }
        ends_.notify_one();
        thread_.join();
    }

    int sampleRateHz_;
    SignalTap tap_;
    std::atomic<std::int64_t> firstFrame_{-1}, playOutFrames_{-1}, written_{0};
    std::atomic<bool> isWhole_{true};

    WavSink wav_; // the thread's; M's once that has ended

    mutable std::mutex mutex_; // guards what follows
    std::condition_variable ends_;
    bool isEnding_ = false;
    std::string error_;

    std::thread thread_; // last: it uses the others
};

} // namespace physvib
