// SPDX-License-Identifier: MIT
// Records a live session as a WAV file and a CSV of its events in the WAV's time; renders saved sessions.
#pragma once
#include "Core/ClockLaw.h"
#include "Core/RenderControl.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/NumberText.h"
#include "Io/Wav/WavSink.h"
#include "Live/Devices/DeviceMeters.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Live/Session/SessionRender.h"
#include "Scene/EventsCsv.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace physvib {

// Records the output of a live session to a WAV file: the render thread fills a ring buffer, another thread
// writes it to disk.

/// Records all channels of the session, or the first ones, before the output's master gain. A file has one
/// sample rate, so the recording ends when the rate changes. The file is a valid WAV from its first samples
/// on: if the program is killed or the disk fills up, only the half second before that is missing. Only
/// finish() waits for the disk.
class PlayedRecorder final : public Sink {
public:
    /// `seconds`: capacity of the buffer, for delays of the disk. M.
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

    /// Frames that find the buffer full are lost and counted. R, wait-free.
    void onBlock(const RenderedBlock& block) noexcept PHYSVIB_NONBLOCKING override {
        if (block.sampleRateHz != sampleRateHz_) isRateUnchanged_.store(false, std::memory_order_relaxed);
        // the output runs before the world's first step: session time stands still, and nothing is to be
        // heard
        if (!isRateUnchanged() || block.sessionFrame < 0) return;
        if (firstFrame_.load(std::memory_order_relaxed) < 0)
            firstFrame_.store(block.sessionFrame, std::memory_order_relaxed);
        tap_.push(block.channels, block.frames);
    }
    /// The sample rate has not changed. Any thread.
    bool isRateUnchanged() const noexcept { return isRateUnchanged_.load(std::memory_order_relaxed); }

    /// Sets the output latency that the file's start time is computed with; before the first frame. M.
    void setOutputLatency(std::int64_t outputLatencyFrames) noexcept {
        outputLatencyFrames_ = outputLatencyFrames;
    }

    /// Writes the last samples and the header. Returns empty, or one line why. M, after R stopped.
    std::string finish() {
        end();
        write();
        return error_ = wav_.finish();
    }

    /// Session frame of the file's first sample; -1: none yet.
    std::int64_t firstFrame() const noexcept { return firstFrame_.load(std::memory_order_relaxed); }
    /// Session time at which the file begins, in seconds: an event at session time t is at t minus this in
    /// the file. Empty before setOutputLatency() and the first frame.
    std::optional<double> startSeconds() const noexcept {
        if (outputLatencyFrames_ < 0 || firstFrame() < 0) return {};
        return static_cast<double>(firstFrame() - outputLatencyFrames_) / sampleRateHz_;
    }
    std::int64_t frames() const noexcept { return framesWritten_; } ///< written to the file. M
    std::uint64_t framesLost() const noexcept { return tap_.framesLost(); }
    float peak() const noexcept { return peak_; } ///< of what was written. M, after finish()

private:
    // With the disk's delay, less than the half second that may be missing after a kill.
    static constexpr std::chrono::milliseconds period{200};

    void run() {
        std::unique_lock lock{mutex_};
        while (!endSignal_.wait_for(lock, period, [this] { return isEnding_; })) {
            lock.unlock();
            write();
            lock.lock();
            error_ = wav_.error();
        }
    }
    void write() {
        const std::int64_t writtenBefore = framesWritten_;
        tap_.read([this](const float* const* channels, int frames) {
            if (const auto start = startSeconds(); start && framesWritten_ == 0)
                wav_.setComment("begins at session time " + fixedNumber(*start, 6) + " s");
            if (wav_.write(channels, frames)) framesWritten_ += frames;
            for (int j = 0; j < tap_.channels(); ++j)
                for (int n = 0; n < frames; ++n) peak_ = std::max(peak_, std::abs(channels[j][n]));
        });
        if (framesWritten_ > writtenBefore) wav_.publish();
    }
    void end() {
        if (!thread_.joinable()) return;
        {
            const std::lock_guard lock{mutex_};
            isEnding_ = true;
        }
        endSignal_.notify_one();
        thread_.join();
    }

    int sampleRateHz_;
    SignalTap tap_;
    std::atomic<std::int64_t> firstFrame_{-1}, outputLatencyFrames_{-1}, framesWritten_{0};
    std::atomic<bool> isRateUnchanged_{true};

    WavSink wav_; // used by the thread; by M once the thread has ended, as the next
    float peak_ = 0.0f;

    mutable std::mutex mutex_; // guards the members below
    std::condition_variable endSignal_;
    bool isEnding_ = false;
    std::string error_;

    std::thread thread_; // last: it uses the other members
};

/// A WAV file and its event list. M only; recorder() is a sink of the session.
class Recording {
public:
    /// `path` ends in .wav; the events go to the same name with .csv.
    Recording(const std::filesystem::path& path, int channels, int sampleRateHz)
        : path_{path}
        , recorder_{path, channels, sampleRateHz} {}

    std::string error() const { return recorder_.error(); }
    PlayedRecorder& recorder() noexcept { return recorder_; }
    std::filesystem::path eventsPath() const {
        return std::filesystem::path{path_}.replace_extension(".csv");
    }

    void addEvent(const PlayedEvent& played) { played_.push_back(played.event); }

    /// Completes both files, after R has stopped. `outputLatencyFrames` is the output latency; `field` is the
    /// field that places refer to; `names` are those of the scene's materials. Empty, or one line why.
    std::string finish(std::int64_t outputLatencyFrames, FieldSize field, const Provenance& provenance,
                       const SoundNames& names) {
        if (auto error = recorder_.finish(); !error.empty()) return error;
        const int rate = recorder_.sampleRateHz();
        const std::int64_t shiftNs = FrameClock{rate}.timeNs(outputLatencyFrames - recorder_.firstFrame());
        const std::int64_t lengthNs = static_cast<std::int64_t>(
            1e9 * static_cast<double>(recorder_.frames()) / static_cast<double>(rate));
        for (auto& event : played_) event.timeNs += shiftNs;
        std::erase_if(played_,
                      [lengthNs](const CollisionEvent& e) { return e.timeNs < 0 || e.timeNs >= lengthNs; });
        std::ranges::stable_sort(played_, {}, &CollisionEvent::timeNs);
        return writeFile(eventsPath(), eventsCsv(played_, field, provenance, names));
    }

private:
    std::filesystem::path path_;
    PlayedRecorder recorder_;
    std::vector<CollisionEvent> played_;
};

// Renders a saved session to a WAV file.

/// Writes the whole file or none. Returns empty, one line with the reason, or "cancelled". Any thread but R.
inline std::string renderSessionWav(const SavedSession& session, const SessionExtent& extent,
                                    const std::string& path, const std::string& comment) {
    const auto loaded = loadRecordings(session.log);
    if (!loaded) return loaded.error;
    if (auto clash = fileClashError({&path, 1}, recordingPaths(session.log)); !clash.empty()) return clash;
    WavSink wav{path, session.channels, extent.sampleRateHz, comment};
    if (!wav.error().empty()) return wav.error();
    const bool isWhole = renderSession(session, loaded.value, extent,
                                       [&](const float* const* block, int n) { return wav.write(block, n); });
    if (!wav.error().empty()) return wav.error();
    return isWhole ? wav.finish() : "cancelled";
}

} // namespace physvib
