// SPDX-License-Identifier: GPL-3.0-or-later
// A WAV file that grows block by block: 32-bit float, one discrete channel per enchanter.
#pragma once
#include "Files/Disk/AtomicFile.h"
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace juce {
class AudioFormatWriter;
}

namespace physvib {

/// Writes as the blocks come, and puts the file in its place at the end; M only. One and two channels are plain
/// WAVE_FORMAT_IEEE_FLOAT, three and more WAVE_FORMAT_EXTENSIBLE with an empty speaker mask (channels are enchanters, not
/// speakers), 4 GB and more RF64. The bytes depend on the samples and the comment alone.
class WavSink {
public:
    /// Begins a file that appears at `path` (see AtomicFile). `comment` (who made this, from what) becomes its INFO comment.
    WavSink(const std::filesystem::path& path, int channels, int sampleRateHz, const std::string& comment = {});
    ~WavSink();

    /// Another comment than the constructor's; before the first frame.
    void setComment(const std::string& comment) { comment_ = comment; }

    /// Empty, or one line with the file and the reason.
    const std::string& error() const noexcept { return file_.error(); }

    /// Appends `frames` samples of each channel. False after the first error.
    bool write(const float* const* channels, int frames);

    /// Every sample and the header are with the system: nothing but the name is missing. Returns error().
    const std::string& complete();

    /// Completes the file and puts it in its place. Returns error(); after one there is no file.
    const std::string& finish();

private:
    void begin();
    std::string extensibleHeader() const;

    AtomicFile file_;
    int channels_;
    int sampleRateHz_;
    std::string comment_;
    std::int64_t dataBytes_ = 0;
    bool isComplete_ = false;
    std::unique_ptr<juce::AudioFormatWriter> writer_; // from the first frame until complete()
};

} // namespace physvib
