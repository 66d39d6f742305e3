// SPDX-License-Identifier: GPL-3.0-or-later
// Thread that writes the ring buffer of a live recording to disk.
#include "Host/Recordings/PlayedRecorder.h"
#include "Io/Text/NumberText.h"
#include <chrono>

namespace physvib {

namespace {

constexpr std::chrono::milliseconds period{200}; // with the disk's own delay, shorter than the audio that may
                                                 // be lost when the process is killed

} // namespace

PlayedRecorder::PlayedRecorder(const std::filesystem::path& path, int channels, int sampleRateHz,
                               double seconds)
    : sampleRateHz_{sampleRateHz}
    , tap_{channels, static_cast<int>(seconds * sampleRateHz)}
    , wav_{path, channels, sampleRateHz}
    , error_{wav_.error()} {
    if (error_.empty()) thread_ = std::thread{[this] { run(); }};
}

std::string PlayedRecorder::error() const {
    const std::lock_guard lock{mutex_};
    return error_;
}

void PlayedRecorder::run() {
    std::unique_lock lock{mutex_};
    while (!ends_.wait_for(lock, period, [this] { return isEnding_; })) {
        lock.unlock();
        write();
        lock.lock();
        error_ = wav_.error();
    }
}

void PlayedRecorder::write() {
    const std::int64_t before = written_;
    tap_.read([this](const float* const* channels, int frames) {
        if (const auto begins = beginsSeconds(); begins && written_ == 0)
            wav_.setComment("begins at session time " + fixedNumber(*begins, 6) + " s");
        if (wav_.write(channels, frames)) written_ += frames;
    });
    if (written_ > before) wav_.show();
}

void PlayedRecorder::end() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock{mutex_};
        isEnding_ = true;
    }
    ends_.notify_one();
    thread_.join();
}

std::string PlayedRecorder::finish() {
    end();
    write();
    return wav_.finish();
}

} // namespace physvib
