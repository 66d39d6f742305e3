// SPDX-License-Identifier: MIT
// Writes a WAV file block by block: 32-bit float, one channel per actuator, with a provenance comment.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Io/Wav/WavHead.h"
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>

namespace physvib {

/// Writes blocks as they arrive, and puts the file in its place at the end. Message thread (M) only. One and
/// two channels are plain WAVE_FORMAT_IEEE_FLOAT, three and more WAVE_FORMAT_EXTENSIBLE with an empty speaker
/// mask (channels are actuators, not speakers), 4 GB and more RF64. The bytes depend on the samples and the
/// comment alone.
class WavSink {
public:
    /// Begins a file that appears at `path` (see AtomicFile). `comment` (who made this, from what) becomes
    /// its INFO comment.
    WavSink(const std::filesystem::path& path, int channels, int sampleRateHz,
            const std::string& comment = {})
        : file_{path}
        , channels_{channels}
        , sampleRateHz_{sampleRateHz} {
        setComment(comment);
    }

    /// Replaces the constructor's comment; only before the first frame.
    void setComment(const std::string& comment) { info_ = wavInfo(comment); }

    /// Empty, or one line with the file and the reason.
    const std::string& error() const noexcept { return file_.error(); }

    /// Appends `frames` samples of each channel. False after the first error.
    bool write(const float* const* channels, int frames) {
        if (!error().empty() || isComplete_) return false;
        const std::size_t before = waiting_.size();
        waiting_.resize(before + static_cast<std::size_t>(frames) * static_cast<std::size_t>(channels_) *
                                     sizeof(float));
        char* to = waiting_.data() + before;
        for (int n = 0; n < frames; ++n)
            for (int j = 0; j < channels_; ++j, to += sizeof(float))
                std::memcpy(to, channels[j] + n, sizeof(float));
        if (waiting_.size() >= bufferBytes) empty();
        return error().empty();
    }

    /// Makes everything written so far a complete file in its place, whatever ends the program; later samples
    /// are added to it. Returns error(); after an error the file is as it was at the last call.
    const std::string& show() {
        if (isComplete_) return error();
        writeHead();
        return file_.show();
    }

    /// Writes all samples and the header; only the rename is left. Returns error().
    const std::string& complete() {
        if (std::exchange(isComplete_, true)) return error();
        writeHead();
        return error();
    }

    /// Completes the file and puts it in its place. Returns error(); after an error only what show() has
    /// placed is left.
    const std::string& finish() { return complete().empty() ? file_.commit() : error(); }

private:
    static_assert(std::endian::native == std::endian::little, "samples are written as they are");
    static constexpr std::size_t bufferBytes = 1 << 18; // a quarter of a megabyte per system call

    void empty() {
        if (file_.writeAt(wavHeadBytes + std::ssize(info_) + dataBytes_, waiting_))
            dataBytes_ += std::ssize(waiting_);
        waiting_.clear();
    }
    // After the samples, so that it never claims more than was written.
    void writeHead() {
        empty();
        file_.writeAt(0, wavHead(channels_, sampleRateHz_, dataBytes_, info_));
    }

    AtomicFile file_;
    int channels_;
    int sampleRateHz_;
    std::string info_;    // the chunk with the comment
    std::string waiting_; // samples not written yet
    std::int64_t dataBytes_ = 0;
    bool isComplete_ = false;
};

} // namespace physvib
