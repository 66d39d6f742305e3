// SPDX-License-Identifier: MIT
// A WAVE file that grows block by block: 32-bit float, one channel per enchanter, who made it and from what.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Io/Wav/WavHead.h"
#include <cstdint>
#include <filesystem>
#include <string>

namespace physvib {

/// Writes as the blocks come, and puts the file in its place at the end; M only. One and two channels are
/// plain WAVE_FORMAT_IEEE_FLOAT, three and more WAVE_FORMAT_EXTENSIBLE with an empty speaker mask (channels
/// are enchanters, not speakers), 4 GB and more RF64. The bytes depend on the samples and the comment alone.
class WavSink {
public:
    /// Begins a file that appears at `path` (see AtomicFile). `comment` (who made this, from what) becomes
    /// its INFO comment.
    WavSink(const std::filesystem::path& path, int channels, int sampleRateHz,
            const std::string& comment = {});

    /// Another comment than the constructor's; before the first frame.
    void setComment(const std::string& comment);

    /// Empty, or one line with the file and the reason.
    const std::string& error() const noexcept { return file_.error(); }

    /// Appends `frames` samples of each channel. False after the first error.
    bool write(const float* const* channels, int frames);

    /// What was written until now is a whole file in its place, whatever ends the program; what follows is
    /// added to it. Returns error(); after one it is what it was at the call before.
    const std::string& show();

    /// Every sample and the header are with the system: nothing but the name is missing. Returns error().
    const std::string& complete();

    /// Completes the file and puts it in its place. Returns error(); after one nothing but what was shown.
    const std::string& finish() { return complete().empty() ? file_.commit() : error(); }

private:
    void empty();
    void writeHead();

    AtomicFile file_;
    int channels_;
    int sampleRateHz_;
    std::string info_;    // the chunk with the comment
    std::string waiting_; // samples that the file has not got
    std::int64_t dataBytes_ = 0;
    bool isComplete_ = false;
};

} // namespace physvib
