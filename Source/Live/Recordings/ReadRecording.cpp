// SPDX-License-Identifier: MIT
// Reads sounds by libsndfile, which reads what SoundHeader.cpp has checked and nothing else of the file;
// clips by Formats.
#include "Live/Recordings/ReadRecording.h"
#include "Formats/ClipFile.h"
#include "Formats/StrikeClip.h"
#include "Io/Disk/ReadFile.h"
#include "Measure/HitExcerpt.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <sndfile.h>
#include <span>
#include <vector>

namespace physvib {
namespace {

constexpr int clipRateHz = 48000; // sample rate of clips, which are curves

/// The file as libsndfile sees it, with a limit of the bytes read: a decoder may seek the end and go back,
/// and a hostile file could make it do so for long.
class LimitedFile {
public:
    LimitedFile(std::FILE& file, const SoundHeader& sound)
        : file_{file}
        , sound_{sound}
        , bytesLeft_{maxPasses * length() + (1 << 20)} {}

    sf_count_t length() const noexcept { return std::ssize(sound_.head) + sound_.bytes; }
    sf_count_t seek(sf_count_t offset, int whence) noexcept {
        const sf_count_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? position_ : length();
        return position_ = std::clamp<sf_count_t>(from + offset, 0, length());
    }
    sf_count_t tell() const noexcept { return position_; }
    sf_count_t read(char* target, sf_count_t count) {
        count = std::min(count, length() - position_);
        bytesLeft_ -= count;
        if (count <= 0 || bytesLeft_ < 0) return 0;
        const auto inHead = std::clamp<sf_count_t>(std::ssize(sound_.head) - position_, 0, count);
        if (inHead > 0) std::memcpy(target, sound_.head.data() + position_, static_cast<std::size_t>(inHead));
        position_ += inHead;
        if (inHead == count) return count;
        std::fseek(&file_, static_cast<long>(sound_.begin + position_ - std::ssize(sound_.head)), SEEK_SET);
        const auto fetched = std::fread(target + inHead, 1, static_cast<std::size_t>(count - inHead), &file_);
        position_ += static_cast<sf_count_t>(fetched);
        return inHead + static_cast<sf_count_t>(fetched);
    }

private:
    static constexpr sf_count_t maxPasses = 4;
    std::FILE& file_;
    const SoundHeader& sound_;
    sf_count_t bytesLeft_, position_ = 0;
};

LimitedFile& limitedFile(void* user) { return *static_cast<LimitedFile*>(user); }

struct CloseSound {
    void operator()(SNDFILE* file) const noexcept { sf_close(file); }
};

/// One pass over the samples.
class SoundPass {
public:
    SoundPass(std::FILE& file, const SoundHeader& sound, float gain = 1.0f)
        : limitedFile_{file, sound}
        , gain_{gain} {
        if (sound.format != 0)
            info_ = {0,
                     static_cast<int>(sound.shape.sampleRateHz),
                     static_cast<int>(sound.shape.channels),
                     sound.format,
                     0,
                     0};
        SF_VIRTUAL_IO io{
            [](void* user) { return limitedFile(user).length(); },
            [](sf_count_t offset, int whence, void* user) { return limitedFile(user).seek(offset, whence); },
            [](void* target, sf_count_t count, void* user) {
                return limitedFile(user).read(static_cast<char*>(target), count);
            },
            [](const void*, sf_count_t, void*) { return sf_count_t{0}; },
            [](void* user) { return limitedFile(user).tell(); }};
        soundFile_.reset(sf_open_virtual(&io, SFM_READ, &info_, &limitedFile_));
        const int type = info_.format & SF_FORMAT_SUBMASK;
        isInteger_ = (type >= SF_FORMAT_PCM_S8 && type <= SF_FORMAT_PCM_U8) || type == SF_FORMAT_ULAW ||
                     type == SF_FORMAT_ALAW;
        constexpr int floatCodecs[] = {SF_FORMAT_FLOAT, SF_FORMAT_DOUBLE, SF_FORMAT_VORBIS, SF_FORMAT_OPUS};
        if (!soundFile_)
            error_ = std::string{"cannot be decoded: "} + sf_strerror(nullptr);
        else if (!isInteger_ && std::ranges::count(floatCodecs, type) == 0)
            error_ = "expected PCM, float, Vorbis or Opus, found another codec";
    }

    /// Empty, or why it cannot be read.
    const std::string& error() const noexcept { return error_; }
    SoundFormat shape() const noexcept { return {info_.samplerate, info_.channels, info_.frames}; }

    /// Reads up to `maxFrames` frames into samples(). Returns their number; 0 at the end.
    std::int64_t next(std::int64_t maxFrames) {
        const auto frames = std::min<sf_count_t>(maxFrames, blockFrames);
        floats_.resize(static_cast<std::size_t>(blockFrames * info_.channels));
        if (!isInteger_) return sf_readf_float(soundFile_.get(), floats_.data(), frames);
        integers_.resize(floats_.size());
        const auto count = sf_readf_int(soundFile_.get(), integers_.data(), frames); // full scale is 2^31
        std::ranges::transform(integers_, floats_.begin(),
                               [this](int x) { return static_cast<float>(x) * (gain_ * 0x1p-31f); });
        return count;
    }
    const std::vector<float>& samples() const noexcept { return floats_; }                    ///< interleaved
    bool isDamaged() const noexcept { return sf_error(soundFile_.get()) != SF_ERR_NO_ERROR; } ///< in next()

private:
    static constexpr sf_count_t blockFrames = 4096;
    LimitedFile limitedFile_;
    float gain_;
    SF_INFO info_{};
    std::unique_ptr<SNDFILE, CloseSound> soundFile_;
    bool isInteger_ = false;
    std::string error_;
    std::vector<float> floats_;
    std::vector<int> integers_;
};

std::string damageError(const std::string& expected, std::int64_t frames) {
    return "expected " + expected + ", found damage or the end after " + std::to_string(frames);
}

/// Reads all samples to find their number, and the gain for their alignment in a wider container: WAVE has
/// them in the upper bits, but ALSA's arecord writes them into the lower ones. Empty, or the error.
std::string scanSamples(std::FILE& file, const SoundHeader& sound, std::int64_t maxSeconds,
                        SoundFormat& shape, float& gain) {
    SoundPass pass{file, sound};
    if (!pass.error().empty()) return pass.error();
    const float maxLow = std::ldexp(1.0f, sound.bits - sound.containerBits),
                steps = std::ldexp(1.0f, sound.bits - 1);
    bool fitsLow = sound.bits < sound.containerBits, usesLowerBits = false;
    std::int64_t frames = 0;
    while (frames <= maxSeconds * shape.sampleRateHz) {
        const auto count = pass.next(4096);
        if (pass.isDamaged()) return damageError("samples to the end", frames);
        if (count <= 0) break;
        for (const float x :
             std::span{pass.samples()}.first(static_cast<std::size_t>(count * shape.channels))) {
            fitsLow = fitsLow && x >= -maxLow && x < maxLow;
            usesLowerBits = usesLowerBits || x * steps != std::trunc(x * steps);
        }
        frames += count;
    }
    if (sound.isLowAligned && usesLowerBits && !fitsLow)
        return "expected the upper or the lower " + std::to_string(sound.bits) + " bits, found others";
    if (fitsLow && (usesLowerBits || sound.isLowAligned)) gain = 1.0f / maxLow;
    shape.frames = frames;
    return {};
}

std::string decodeAll(SoundPass& pass, const SoundFormat& shape, SoundReceiver& receiver) {
    const auto channels = static_cast<std::size_t>(shape.channels);
    const std::string claimed = std::to_string(shape.frames) + " samples in each channel, as its header says";
    std::vector<std::vector<float>> block(channels);
    std::vector<const float*> channelData(channels);
    for (std::int64_t done = 0, count = 0; done < shape.frames; done += count) {
        count = pass.next(shape.frames - done);
        if (count <= 0 || pass.isDamaged()) return damageError(claimed, done);
        for (std::size_t j = 0; j < channels; ++j) {
            block[j].resize(static_cast<std::size_t>(count));
            for (std::size_t i = 0; i < block[j].size(); ++i) block[j][i] = pass.samples()[i * channels + j];
            channelData[j] = block[j].data();
            const auto invalid = std::ranges::find_if(block[j], [](float x) { return !std::isfinite(x); });
            if (invalid != block[j].end())
                return nonFiniteError(*invalid, static_cast<std::size_t>(done + (invalid - block[j].begin())),
                                      static_cast<double>(shape.sampleRateHz)) +
                       " in channel " + std::to_string(j + 1);
        }
        if (auto error = receiver.receive(channelData.data(), static_cast<int>(count)); !error.empty())
            return error;
    }
    return pass.next(1) > 0 && !pass.isDamaged() ? "expected " + claimed + ", found more" : "";
}

} // namespace

Result<SampledSound> clipToSound(const Clip& clip, const std::filesystem::path& path) {
    const SoundFormat shape{clipRateHz, static_cast<std::int64_t>(clip.channels.size()),
                            static_cast<std::int64_t>(clip.seconds() * clipRateHz)};
    if (auto error = soundError(shape); !error.empty()) return Failure{path.string() + ": " + error};
    return clipSound(clip, clipRateHz);
}

Result<SampledSound> readRecording(const std::filesystem::path& path) {
    const auto file = openRegularFile(path, limits::maxRecordingFileBytes);
    if (!file) return Failure{file.error};
    if (const auto format = findClipFormat(path.string())) {
        const auto clip = loadClip(path, *format);
        return clip ? clipToSound(clip.value, path) : Failure{clip.error};
    }
    SoundBuffer buffer;
    const auto error = decodeSound(*file.value.stream, static_cast<std::int64_t>(file.value.bytes),
                                   limits::maxRecordingSeconds, buffer);
    if (!error.empty()) return Failure{path.string() + ": " + error};
    return std::move(buffer.sound);
}

std::string removeSlowPart(SampledSound& sound, const std::filesystem::path& path, double fullScale) {
    SlowPart removed;
    for (auto& samples : sound.channels)
        removed.mergeMax(removeSlowPart(samples, sound.sampleRateHz, fullScale));
    return removed.isPresent() ? cleanLine(path.string() + ": " + removed.text()) : "";
}

std::string streamRecording(const std::filesystem::path& path, SoundReceiver& receiver) {
    const auto file = openRegularFile(path, limits::maxMusicFileBytes);
    if (!file) return file.error;
    const auto error = decodeSound(*file.value.stream, static_cast<std::int64_t>(file.value.bytes),
                                   limits::maxMusicSeconds, receiver);
    return error.empty() ? error : path.string() + ": " + error;
}

std::string decodeSound(std::FILE& file, std::int64_t bytes, std::int64_t maxSeconds,
                        SoundReceiver& receiver) {
    const auto head = readSoundHeader(file, bytes);
    if (!head) return head.error;
    const SoundHeader& sound = head.value;
    SoundFormat shape = sound.shape;
    const bool isLengthKnown = shape.frames > 0;
    // before the library reads anything, if the header has the number of samples
    if (auto error = isLengthKnown ? receiver.begin(shape) : ""; !error.empty()) return error;
    float gain = 1.0f;
    if (sound.needsScan)
        if (auto error = scanSamples(file, sound, maxSeconds, shape, gain); !error.empty()) return error;
    SoundPass pass{file, sound, gain};
    if (!pass.error().empty()) return pass.error();
    if (shape.frames == 0) shape = pass.shape();
    if (auto error = isLengthKnown ? "" : receiver.begin(shape); !error.empty()) return error;
    return decodeAll(pass, shape, receiver);
}

} // namespace physvib
