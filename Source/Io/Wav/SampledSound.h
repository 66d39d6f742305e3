// SPDX-License-Identifier: MIT
// Samples of a recording, independent of its file format, the receivers of its blocks, and its limits.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// Samples of every channel, all of equal length.
struct SampledSound {
    int sampleRateHz = 0;
    std::vector<std::vector<float>> channels;
};

/// Format as a file's header states it, unchecked; `frames` are samples per channel.
struct SoundFormat {
    std::int64_t sampleRateHz = 0;
    std::int64_t channels = 0;
    std::int64_t frames = 0;
};

/// Empty, or why such a sound is refused; checked before memory is allocated. Any thread.
std::string soundError(const SoundFormat& format);

/// Empty, or why a sound is refused that is read block by block and not stored. Any thread.
std::string streamError(const SoundFormat& format);

/// Receives a sound from a reader, block by block. One thread at a time.
class SoundReceiver {
public:
    /// Called once with the header, before all samples. Returns empty, or why the sound is refused.
    virtual std::string begin(const SoundFormat& format) = 0;
    /// channels[channel][0..frames), the next samples. Returns empty, or why reading is to stop.
    virtual std::string receive(const float* const* channels, int frames) = 0;

protected:
    ~SoundReceiver() = default;
};

/// A receiver that stores the whole sound.
class SoundBuffer final : public SoundReceiver {
public:
    std::string begin(const SoundFormat& format) override;
    std::string receive(const float* const* channels, int frames) override;
    SampledSound sound;
};

} // namespace physvib
