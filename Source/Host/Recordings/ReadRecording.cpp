// SPDX-License-Identifier: GPL-3.0-or-later
// Reads WAV with a parser of this project, FLAC and Ogg Vorbis with JUCE's. JUCE trusts the header, so the
// header is checked first.
#include "Host/Recordings/ReadRecording.h"
#include "Formats/ClipFile.h"
#include "Formats/ClipSound.h"
#include "Io/Disk/FileLimits.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Wav/WavFile.h"
#include "Measure/SlowPart.h"
#include <algorithm>
#include <array>
#include <cstdint>
#include <juce_audio_formats/juce_audio_formats.h>
#include <string_view>

namespace physvib {
namespace {

constexpr int blockFrames = 1 << 16;
constexpr int vorbisReadsAhead = 4096; // JUCE's reader reads ahead, even past the end

constexpr const char* notASound = "expected a WAV, FLAC or Ogg Vorbis file";

/// Empty, or why JUCE's reader must not read the file: it uses the last of several stream descriptions, scans
/// the whole file if the length is missing, and truncates the length to 32 bits.
std::string flacFault(std::FILE& file) {
    std::array<unsigned char, 42> head{}; // "fLaC", a block header, the stream description
    if (std::fread(head.data(), 1, head.size(), &file) != head.size() || (head[4] & 0x7f) != 0)
        return notASound;
    const auto at = [&](std::size_t i) { return static_cast<std::int64_t>(head[i]); };
    const SoundShape shape{at(18) << 12 | at(19) << 4 | at(20) >> 4, (at(20) >> 1 & 7) + 1,
                           (at(21) & 15) << 32 | at(22) << 24 | at(23) << 16 | at(24) << 8 | at(25)};
    if (shape.frames == 0) return "expected a FLAC file that says how long it is";
    if (shape.frames > UINT32_MAX)
        return "expected at most " + std::to_string(UINT32_MAX) + " samples in each channel, found " +
               std::to_string(shape.frames);
    bool isLast = (head[4] & 0x80) != 0;
    for (std::array<unsigned char, 4> block{};
         !isLast && std::fread(block.data(), 1, block.size(), &file) == block.size();) {
        if ((block[0] & 0x7f) == 0) return "expected one description of the stream";
        isLast = (block[0] & 0x80) != 0;
        if (std::fseek(&file, block[1] << 16 | block[2] << 8 | block[3], SEEK_CUR) != 0) break;
    }
    return streamFault(shape);
}

/// Empty, or the error that several streams are chained: JUCE's reader assumes the channel count of the last
/// for all.
std::string oggFault(std::FILE& file) {
    constexpr std::string_view page{"OggS\0", 5};
    constexpr char begins = 2;
    std::string block(page.size(), '\0');
    int streams = 0;
    for (std::array<char, 65536> bytes;
         const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), &file);) {
        // the mark of a page may be split over two blocks
        block.erase(0, block.size() - page.size()).append(bytes.data(), count);
        for (std::size_t i = block.find(page); i != std::string::npos && i + page.size() < block.size();
             i = block.find(page, i + 1))
            streams += (block[i + page.size()] & begins) != 0;
    }
    return streams == 1 ? "" : streams == 0 ? notASound : "expected one stream of sound, found several";
}

/// File stream for JUCE's decoders. It limits the bytes read, and records whether a decoder asked for more.
class RecordingStream final : public juce::InputStream {
public:
    RecordingStream(std::FILE& file, std::int64_t bytes)
        : file_{file}
        , size_{bytes}
        , left_{mostRounds * bytes + (1 << 20)} {}

    /// Whether a decoder asked for more than the file has (or too often for the same bytes) since forget().
    bool isAskedTooMuch() const noexcept { return isAskedTooMuch_; }
    void forget() noexcept { isAskedTooMuch_ = false; }

    juce::int64 getTotalLength() override { return size_; }
    juce::int64 getPosition() override { return position_; }
    bool setPosition(juce::int64 wanted) override {
        position_ = std::clamp<std::int64_t>(wanted, 0, size_);
        return std::fseek(&file_, static_cast<long>(position_), SEEK_SET) == 0;
    }
    bool isExhausted() override { return noteIf(position_ >= size_ || left_ <= 0); }
    int read(void* to, int wanted) override {
        const auto count = std::min<std::int64_t>({wanted, size_ - position_, left_});
        if (noteIf(count <= 0)) return 0;
        const auto taken = static_cast<int>(std::fread(to, 1, static_cast<std::size_t>(count), &file_));
        position_ += taken;
        left_ -= taken;
        return taken;
    }

private:
    static constexpr std::int64_t mostRounds = 4; // a decoder seeks the end, goes back, and reads once

    bool noteIf(bool isTooMuch) noexcept {
        isAskedTooMuch_ = isAskedTooMuch_ || isTooMuch;
        return isTooMuch;
    }

    std::FILE& file_;
    std::int64_t size_, position_ = 0, left_;
    bool isAskedTooMuch_ = false;
};

std::unique_ptr<juce::AudioFormatReader> openReader(std::unique_ptr<juce::InputStream> stream) {
    juce::AudioFormatManager formats;
    formats.registerBasicFormats();
    return std::unique_ptr<juce::AudioFormatReader>{formats.createReaderFor(std::move(stream))};
}

std::string decode(std::FILE& file, std::size_t fileBytes, bool isOgg, SoundTaker& taker) {
    auto owned = std::make_unique<RecordingStream>(file, static_cast<std::int64_t>(fileBytes));
    RecordingStream& stream = *owned;
    const auto reader = openReader(std::move(owned));
    if (!reader) return notASound;
    const SoundShape shape{juce::roundToInt(reader->sampleRate),
                           static_cast<std::int64_t>(reader->numChannels), reader->lengthInSamples};
    if (auto fault = taker.begin(shape); !fault.empty()) return fault;
    juce::AudioBuffer<float> block(static_cast<int>(shape.channels), blockFrames);
    stream.forget();
    for (std::int64_t at = 0; at < shape.frames;) {
        const auto count = static_cast<int>(std::min<std::int64_t>(blockFrames, shape.frames - at));
        const bool isRead = reader->read(&block, 0, count, at, true, true);
        at += count;
        if (!isRead || (stream.isAskedTooMuch() && !(isOgg && shape.frames - at < vorbisReadsAhead)))
            return "expected " + std::to_string(shape.frames) +
                   " samples in each channel, as its header says: it ends early";
        if (auto fault = taker.take(block.getArrayOfReadPointers(), count); !fault.empty()) return fault;
    }
    return {};
}

std::string streamSound(std::FILE& file, std::size_t fileBytes, SoundTaker& taker) {
    std::array<char, 4> head{};
    const std::string_view kind{head.data(), std::fread(head.data(), 1, head.size(), &file)};
    std::rewind(&file);
    if (kind == "RIFF" || kind == "RF64") return streamWav(file, taker);
    if (kind != "fLaC" && kind != "OggS") return notASound;
    const bool isOgg = kind == "OggS";
    if (auto fault = isOgg ? oggFault(file) : flacFault(file); !fault.empty()) return fault;
    std::rewind(&file);
    return decode(file, fileBytes, isOgg, taker);
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
