// SPDX-License-Identifier: MIT
// Writes a WAV file block by block: 32-bit float, one channel per actuator, with a provenance comment.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Io/Wav/WavHeader.h"
#include <cstdint>
#include <filesystem>
#include <string>

namespace physvib {

/// Writes blocks as they arrive, and puts the file in its place at the end. Message thread only. One and two
/// channels are plain WAVE_FORMAT_IEEE_FLOAT, three and more WAVE_FORMAT_EXTENSIBLE with an empty speaker
/// mask (channels are actuators, not speakers), 4 GB and more RF64.
class WavSink {
public:
    /// Begins a file that appears at `path` (see AtomicFile). `comment`: text of its INFO chunk.
    WavSink(const std::filesystem::path& path, int channels, int sampleRateHz,
            const std::string& comment = {});

    /// Replaces the constructor's comment; only before the first frame.
    void setComment(const std::string& comment);

    /// Empty, or one line with the file and the reason.
    const std::string& error() const noexcept { return file_.error(); }

    /// Appends `frames` samples of each channel. False after the first error.
    bool write(const float* const* channels, int frames);

    /// Makes everything written so far a complete file in its place, whatever ends the program; later samples
    /// are added to it. Returns error(); after an error the file is as it was at the last call.
    const std::string& publish();

    /// Writes all samples and the header; finish() then only renames. Returns error().
    const std::string& complete();

    /// Completes the file and puts it in its place. Returns error(); after an error only what publish() wrote
    /// remains.
    const std::string& finish() { return complete().empty() ? file_.commit() : error(); }

private:
    void flushBuffer();
    void writeHeader();

    AtomicFile file_;
    int channels_;
    int sampleRateHz_;
    std::string infoChunk_; // the chunk with the comment
    std::string buffer_;    // samples not written yet
    std::int64_t dataBytes_ = 0;
    bool isComplete_ = false;
};

} // namespace physvib
