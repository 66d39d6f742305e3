// SPDX-License-Identifier: MIT
// Checks a sound's format against the limits of recordings, and collects its samples.
#include "Io/Wav/SampledSound.h"
#include "Io/Disk/ReadFile.h"

namespace physvib {
namespace {

std::string expectedButFound(const std::string& expected, std::int64_t found, const char* unit) {
    return "expected " + expected + ", found " + std::to_string(found) + unit;
}

std::string formatError(const SoundFormat& format, std::int64_t maxSeconds) {
    using namespace limits;
    if (format.channels < 1 || format.channels > maxRecordingChannels)
        return expectedButFound("1 to " + std::to_string(maxRecordingChannels) + " channels", format.channels,
                                "");
    if (format.sampleRateHz < minRecordingRateHz || format.sampleRateHz > maxRecordingRateHz)
        return expectedButFound("a rate of " + std::to_string(minRecordingRateHz) + " to " +
                                    std::to_string(maxRecordingRateHz) + " Hz",
                                format.sampleRateHz, " Hz");
    if (format.frames < 1) return "expected samples, found none";
    if (format.frames > maxSeconds * format.sampleRateHz)
        return expectedButFound("at most " + std::to_string(maxSeconds) + " s",
                                format.frames / format.sampleRateHz, " s");
    return {};
}

} // namespace

std::string streamError(const SoundFormat& format) { return formatError(format, limits::maxMusicSeconds); }

std::string soundError(const SoundFormat& format) {
    using namespace limits;
    if (auto error = formatError(format, maxRecordingSeconds); !error.empty()) return error;
    if (format.frames > maxRecordingSamples / format.channels)
        return expectedButFound("at most " + std::to_string(maxRecordingSamples) + " samples in all channels",
                                format.frames * format.channels, "");
    return {};
}

std::string SoundBuffer::begin(const SoundFormat& format) {
    if (auto error = soundError(format); !error.empty()) return error;
    sound = {static_cast<int>(format.sampleRateHz),
             std::vector<std::vector<float>>(static_cast<std::size_t>(format.channels))};
    for (auto& channel : sound.channels) channel.reserve(static_cast<std::size_t>(format.frames));
    return {};
}

std::string SoundBuffer::receive(const float* const* channels, int frames) {
    for (std::size_t j = 0; j < sound.channels.size(); ++j)
        sound.channels[j].insert(sound.channels[j].end(), channels[j], channels[j] + frames);
    return {};
}

} // namespace physvib
