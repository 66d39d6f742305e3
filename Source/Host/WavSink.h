// SPDX-License-Identifier: GPL-3.0-or-later
// A WAV file that grows block by block: 32-bit float, one discrete channel per enchanter.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

namespace juce {
class AudioFormatWriter;
class FileOutputStream;
} // namespace juce

namespace physvib {

/// Writes `path` as the blocks come; M only. One and two channels are plain WAVE_FORMAT_IEEE_FLOAT, three and
/// more WAVE_FORMAT_EXTENSIBLE with an empty speaker mask (channels are enchanters, not speakers), 4 GB and
/// more RF64. The bytes depend on the samples alone. The file is complete after finish() only, so a caller
/// who must not leave half a file writes to a temporary one and renames it.
class WavSink {
public:
    /// Empties or creates the file. `comment` (who made this, from what) becomes its INFO comment. Errors
    /// call the file `name`, if given: what the user knows, where `path` is temporary.
    WavSink(const std::string& path, int channels, int sampleRateHz, const std::string& comment = {},
            const std::string& name = {});
    ~WavSink();

    /// Appends `frames` samples of each channel. False after the first error, which finish() will tell.
    bool write(const float* const* channels, int frames);

    /// Completes the header and closes; empty if every byte arrived, else one line with the file and the
    /// reason.
    std::string finish();

private:
    void writeExtensibleHeader();
    void noteError();

    std::string path_;
    std::string name_;
    int channels_;
    int sampleRateHz_;
    std::int64_t headerBytes_ = 0;
    std::int64_t dataBytes_ = 0;
    std::string error_;
    std::unique_ptr<juce::FileOutputStream> file_;
    std::unique_ptr<juce::AudioFormatWriter> writer_;
};

} // namespace physvib
