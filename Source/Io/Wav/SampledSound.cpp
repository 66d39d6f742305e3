// SPDX-License-Identifier: MIT
// Checks a sound against the limits of recordings, and collects its samples.
#include "Io/Wav/SampledSound.h"
#include "Io/Disk/ReadFile.h"

namespace physvib {
namespace {

std::string expectedSound(const std::string& words, std::int64_t found, const char* unit) {
    return "expected " + words + ", found " + std::to_string(found) + unit;
}

std::string faultWithin(const SoundShape& shape, std::int64_t mostSeconds) {
    using namespace limits;
    if (shape.channels < 1 || shape.channels > maxRecordingChannels)
        return expectedSound("1 to " + std::to_string(maxRecordingChannels) + " channels", shape.channels,
                             "");
    if (shape.sampleRateHz < minRecordingRateHz || shape.sampleRateHz > maxRecordingRateHz)
        return expectedSound("a rate of " + std::to_string(minRecordingRateHz) + " to " +
                                 std::to_string(maxRecordingRateHz) + " Hz",
                             shape.sampleRateHz, " Hz");
    if (shape.frames < 1) return "expected samples, found none";
    if (shape.frames > mostSeconds * shape.sampleRateHz)
        return expectedSound("at most " + std::to_string(mostSeconds) + " s",
                             shape.frames / shape.sampleRateHz, " s");
    return {};
}

} // namespace

std::string streamFault(const SoundShape& shape) { return faultWithin(shape, limits::maxMusicSeconds); }

std::string soundFault(const SoundShape& shape) {
    using namespace limits;
    if (auto fault = faultWithin(shape, maxRecordingSeconds); !fault.empty()) return fault;
    if (shape.frames > maxRecordingSamples / shape.channels)
        return expectedSound("at most " + std::to_string(maxRecordingSamples) + " samples in all channels",
                             shape.frames * shape.channels, "");
    return {};
}

std::string SoundKeeper::begin(const SoundShape& shape) {
    if (auto fault = soundFault(shape); !fault.empty()) return fault;
    sound = {static_cast<int>(shape.sampleRateHz),
             std::vector<std::vector<float>>(static_cast<std::size_t>(shape.channels))};
    for (auto& channel : sound.channels) channel.reserve(static_cast<std::size_t>(shape.frames));
    return {};
}

std::string SoundKeeper::take(const float* const* channels, int frames) {
    for (std::size_t j = 0; j < sound.channels.size(); ++j)
        sound.channels[j].insert(sound.channels[j].end(), channels[j], channels[j] + frames);
    return {};
}

} // namespace physvib
