// SPDX-License-Identifier: MIT
// Reads WAV with a parser of this project, FLAC and Ogg Vorbis with the decoders of their libraries.
#include "Live/Recordings/ReadRecording.h"
#include "Formats/ClipFile.h"
#include "Formats/ClipSound.h"
#include "Io/Disk/FileLimits.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Wav/WavFile.h"
#include "Live/Recordings/Decoders.h"
#include "Measure/SlowPart.h"
#include <array>
#include <cstdint>
#include <string_view>

namespace physvib {
namespace {

std::string streamSound(std::FILE& file, std::size_t fileBytes, SoundTaker& taker) {
    std::array<char, 4> head{};
    const std::string_view kind{head.data(), std::fread(head.data(), 1, head.size(), &file)};
    std::rewind(&file);
    if (kind == "RIFF" || kind == "RF64") return streamWav(file, taker);
    if (kind != "fLaC" && kind != "OggS") return notASound;
    return kind == "OggS" ? decodeVorbis(file, fileBytes, taker) : decodeFlac(file, taker);
}

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
    if (auto fault = streamSound(*file.value.stream, file.value.bytes, keeper); !fault.empty())
        return Failure{path.string() + ": " + fault};
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
    const auto fault = streamSound(*file.value.stream, file.value.bytes, taker);
    return fault.empty() ? fault : path.string() + ": " + fault;
}

} // namespace physvib
