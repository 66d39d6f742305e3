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

} // namespace physvib
