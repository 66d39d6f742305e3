// SPDX-License-Identifier: MIT
// Reads sounds by DecodeSound.h, clips by Formats.
#include "Live/Recordings/ReadRecording.h"
#include "Formats/ClipFile.h"
#include "Formats/ClipSound.h"
#include "Io/Disk/FileLimits.h"
#include "Io/Disk/ReadFile.h"
#include "Live/Recordings/DecodeSound.h"
#include "Measure/SlowPart.h"
#include <cstdint>

namespace physvib {
namespace {

constexpr int clipRateHz = 48000; // sample rate of clips, which are curves

} // namespace

Result<SampledSound> soundOf(const Clip& clip, const std::filesystem::path& path) {
    const SoundShape shape{clipRateHz, static_cast<std::int64_t>(clip.channels.size()),
                           static_cast<std::int64_t>(clip.seconds() * clipRateHz)};
    if (auto fault = soundFault(shape); !fault.empty()) return Failure{path.string() + ": " + fault};
    return clipSound(clip, clipRateHz);
}

Result<SampledSound> readRecording(const std::filesystem::path& path) {
    const auto file = openRegular(path, limits::maxRecordingFileBytes);
    if (!file) return Failure{file.error};
    if (const auto format = clipFormatOf(path.string())) {
        const auto clip = loadClip(path, *format);
        return clip ? soundOf(clip.value, path) : Failure{clip.error};
    }
    SoundKeeper keeper;
    const auto fault = decodeSound(*file.value.stream, static_cast<std::int64_t>(file.value.bytes),
                                   limits::maxRecordingSeconds, keeper);
    if (!fault.empty()) return Failure{path.string() + ": " + fault};
    return std::move(keeper.sound);
}

std::string takeSlowPart(SampledSound& sound, const std::filesystem::path& path, double fullScale) {
    SlowPart taken;
    for (auto& samples : sound.channels) taken.join(takeSlowPart(samples, sound.sampleRateHz, fullScale));
    return taken.isAny() ? cleanLine(path.string() + ": " + taken.text()) : "";
}

std::string streamRecording(const std::filesystem::path& path, SoundTaker& taker) {
    const auto file = openRegular(path, limits::maxMusicFileBytes);
    if (!file) return file.error;
    const auto fault = decodeSound(*file.value.stream, static_cast<std::int64_t>(file.value.bytes),
                                   limits::maxMusicSeconds, taker);
    return fault.empty() ? fault : path.string() + ": " + fault;
}

} // namespace physvib
