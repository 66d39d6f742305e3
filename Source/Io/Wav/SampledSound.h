// SPDX-License-Identifier: MIT
// Samples of a recording, independent of its file format, and the limits that apply to it.
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

/// Format according to a file's header, which is not trusted.
struct SoundShape {
    std::int64_t sampleRateHz = 0;
    std::int64_t channels = 0;
    std::int64_t frames = 0;
};

/// Empty, or why such a sound is refused; checked before memory is allocated. Any thread.
std::string soundFault(const SoundShape& shape);

/// The same for a sound that is read block by block and not stored. Any thread.
std::string streamFault(const SoundShape& shape);

/// Receiver of a sound, block by block.
class SoundTaker {
public:
    /// Called once with the header, before all samples. Returns empty, or why the sound is refused.
    virtual std::string begin(const SoundShape& shape) = 0;
    /// channels[channel][0..frames), the next samples. Returns empty, or why reading is to stop.
    virtual std::string take(const float* const* channels, int frames) = 0;

protected:
    ~SoundTaker() = default;
};

/// Stores the whole sound.
class SoundKeeper final : public SoundTaker {
public:
    std::string begin(const SoundShape& shape) override;
    std::string take(const float* const* channels, int frames) override;
    SampledSound sound;
};

} // namespace physvib
