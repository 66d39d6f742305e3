// SPDX-License-Identifier: MIT
// What a recording holds, whatever the file it came from, and how much of it is taken.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace physvib {

/// Samples of every channel, all equally long.
struct SampledSound {
    int sampleRateHz = 0;
    std::vector<std::vector<float>> channels;
};

/// What a file's header says; it may lie.
struct SoundShape {
    std::int64_t sampleRateHz = 0;
    std::int64_t channels = 0;
    std::int64_t frames = 0;
};

/// Empty, or why such a sound is not read: asked before memory is taken for it. Any thread.
std::string soundFault(const SoundShape& shape);

/// The same of a sound that is read block by block, and not kept. Any thread.
std::string streamFault(const SoundShape& shape);

/// Who takes a sound block by block.
class SoundTaker {
public:
    /// What its header says, once, before all samples: empty, or why it is not wanted.
    virtual std::string begin(const SoundShape& shape) = 0;
    /// channels[channel][0..frames), the next ones: empty, or why no more is wanted.
    virtual std::string take(const float* const* channels, int frames) = 0;

protected:
    ~SoundTaker() = default;
};

/// Keeps all of it.
class SoundKeeper final : public SoundTaker {
public:
    std::string begin(const SoundShape& shape) override;
    std::string take(const float* const* channels, int frames) override;
    SampledSound sound;
};

} // namespace physvib
