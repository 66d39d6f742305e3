// SPDX-License-Identifier: MIT
// Reads sounds by libsndfile, which reads what SoundHead.cpp has checked and nothing else of the file; clips
// by Formats.
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
class ShownFile {
public:
    ShownFile(std::FILE& file, const SoundHead& sound)
        : file_{file}
        , sound_{sound}
        , left_{mostRounds * length() + (1 << 20)} {}

    sf_count_t length() const noexcept { return std::ssize(sound_.head) + sound_.bytes; }
    sf_count_t seek(sf_count_t offset, int whence) noexcept {
        const sf_count_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? at_ : length();
        return at_ = std::clamp<sf_count_t>(from + offset, 0, length());
    }
    sf_count_t tell() const noexcept { return at_; }
    sf_count_t read(char* to, sf_count_t count) {
        count = std::min(count, length() - at_);
        left_ -= count;
        if (count <= 0 || left_ < 0) return 0;
        const auto ofHead = std::clamp<sf_count_t>(std::ssize(sound_.head) - at_, 0, count);
        if (ofHead > 0) std::memcpy(to, sound_.head.data() + at_, static_cast<std::size_t>(ofHead));
        at_ += ofHead;
        if (ofHead == count) return count;
        std::fseek(&file_, static_cast<long>(sound_.begin + at_ - std::ssize(sound_.head)), SEEK_SET);
        const auto rest = std::fread(to + ofHead, 1, static_cast<std::size_t>(count - ofHead), &file_);
        at_ += static_cast<sf_count_t>(rest);
        return ofHead + static_cast<sf_count_t>(rest);
    }

private:
    static constexpr sf_count_t mostRounds = 4;
    std::FILE& file_;
    const SoundHead& sound_;
    sf_count_t left_, at_ = 0;
};

ShownFile& shown(void* user) { return *static_cast<ShownFile*>(user); }

struct CloseSound {
    void operator()(SNDFILE* open) const noexcept { sf_close(open); }
};

/// One pass over the samples.
class SoundPass {
public:
    SoundPass(std::FILE& file, const SoundHead& sound, float gain = 1.0f)
        : shown_{file, sound}
        , gain_{gain} {
        if (sound.format != 0)
            info_ = {0,
                     static_cast<int>(sound.shape.sampleRateHz),
                     static_cast<int>(sound.shape.channels),
                     sound.format,
                     0,
                     0};
        SF_VIRTUAL_IO io{
            [](void* user) { return shown(user).length(); },
            [](sf_count_t offset, int whence, void* user) { return shown(user).seek(offset, whence); },
            [](void* to, sf_count_t count, void* user) {
                return shown(user).read(static_cast<char*>(to), count);
            },
            [](const void*, sf_count_t, void*) { return sf_count_t{0}; },
            [](void* user) { return shown(user).tell(); }};
        open_.reset(sf_open_virtual(&io, SFM_READ, &info_, &shown_));
        const int type = info_.format & SF_FORMAT_SUBMASK;
        isInteger_ = (type >= SF_FORMAT_PCM_S8 && type <= SF_FORMAT_PCM_U8) || type == SF_FORMAT_ULAW ||
                     type == SF_FORMAT_ALAW;
        constexpr int others[] = {SF_FORMAT_FLOAT, SF_FORMAT_DOUBLE, SF_FORMAT_VORBIS, SF_FORMAT_OPUS};
        if (!open_)
            fault_ = std::string{"cannot be decoded: "} + sf_strerror(nullptr);
        else if (!isInteger_ && std::ranges::count(others, type) == 0)
            fault_ = "expected PCM, float, Vorbis or Opus, found another codec";
    }

    /// Empty, or why it cannot be read.
    const std::string& fault() const noexcept { return fault_; }
    SoundShape shape() const noexcept { return {info_.samplerate, info_.channels, info_.frames}; }

    /// The number of frames that are in samples() then: at most `most`, 0 at the end.
    std::int64_t next(std::int64_t most) {
        const auto frames = std::min<sf_count_t>(most, blockFrames);
        floats_.resize(static_cast<std::size_t>(blockFrames * info_.channels));
        if (!isInteger_) return sf_readf_float(open_.get(), floats_.data(), frames);
        integers_.resize(floats_.size());
        const auto count = sf_readf_int(open_.get(), integers_.data(), frames); // full scale is 2^31
        std::ranges::transform(integers_, floats_.begin(),
                               [this](int x) { return static_cast<float>(x) * (gain_ * 0x1p-31f); });
        return count;
    }
    const std::vector<float>& samples() const noexcept { return floats_; }               ///< interleaved
    bool isDamaged() const noexcept { return sf_error(open_.get()) != SF_ERR_NO_ERROR; } ///< in next()

private:
    static constexpr sf_count_t blockFrames = 4096;
    ShownFile shown_;
    float gain_;
    SF_INFO info_{};
    std::unique_ptr<SNDFILE, CloseSound> open_;
    bool isInteger_ = false;
    std::string fault_;
    std::vector<float> floats_;
    std::vector<int> integers_;
};

std::string damage(const std::string& expected, std::int64_t frames) {
    return "expected " + expected + ", found damage or the end after " + std::to_string(frames);
}

/// Results of a pass over all samples: their number, and their alignment in a container with more bits. WAVE
/// has them in the upper bits; ALSA's arecord writes them into the lower ones.
std::string survey(std::FILE& file, const SoundHead& sound, std::int64_t mostSeconds, SoundShape& shape,
                   float& gain) {
    SoundPass pass{file, sound};
    if (!pass.fault().empty()) return pass.fault();
    const float most = std::ldexp(1.0f, sound.bits - sound.room), steps = std::ldexp(1.0f, sound.bits - 1);
    bool fitsLow = sound.bits < sound.room, isBetween = false;
    std::int64_t frames = 0;
    while (frames <= mostSeconds * shape.sampleRateHz) {
        const auto count = pass.next(4096);
        if (pass.isDamaged()) return damage("samples to the end", frames);
        if (count <= 0) break;
        for (const float x :
             std::span{pass.samples()}.first(static_cast<std::size_t>(count * shape.channels))) {
            fitsLow = fitsLow && x >= -most && x < most;
            isBetween = isBetween || x * steps != std::trunc(x * steps);
        }
        frames += count;
    }
    if (sound.isLowRather && isBetween && !fitsLow)
        return "expected the upper or the lower " + std::to_string(sound.bits) + " bits, found others";
    if (fitsLow && (isBetween || sound.isLowRather)) gain = 1.0f / most;
    shape.frames = frames;
    return {};
}

std::string decodeAll(SoundPass& pass, const SoundShape& shape, SoundTaker& taker) {
    const auto channels = static_cast<std::size_t>(shape.channels);
    const std::string told = std::to_string(shape.frames) + " samples in each channel, as its header says";
    std::vector<std::vector<float>> block(channels);
    std::vector<const float*> at(channels);
    for (std::int64_t done = 0, count = 0; done < shape.frames; done += count) {
        count = pass.next(shape.frames - done);
        if (count <= 0 || pass.isDamaged()) return damage(told, done);
        for (std::size_t j = 0; j < channels; ++j) {
            block[j].resize(static_cast<std::size_t>(count));
            for (std::size_t i = 0; i < block[j].size(); ++i) block[j][i] = pass.samples()[i * channels + j];
            at[j] = block[j].data();
            const auto bad = std::ranges::find_if(block[j], [](float x) { return !std::isfinite(x); });
            if (bad != block[j].end())
                return notFinite(*bad, static_cast<std::size_t>(done + (bad - block[j].begin())),
                                 static_cast<double>(shape.sampleRateHz)) +
                       " in channel " + std::to_string(j + 1);
        }
        if (auto fault = taker.take(at.data(), static_cast<int>(count)); !fault.empty()) return fault;
    }
    return pass.next(1) > 0 && !pass.isDamaged() ? "expected " + told + ", found more" : "";
}

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

std::string decodeSound(std::FILE& file, std::int64_t bytes, std::int64_t mostSeconds, SoundTaker& taker) {
    const auto head = readSoundHead(file, bytes);
    if (!head) return head.error;
    const SoundHead& sound = head.value;
    SoundShape shape = sound.shape;
    const bool isTold = shape.frames > 0;
    // before the library reads anything, if the header has the number of samples
    if (auto fault = isTold ? taker.begin(shape) : ""; !fault.empty()) return fault;
    float gain = 1.0f;
    if (sound.isSurveyed)
        if (auto fault = survey(file, sound, mostSeconds, shape, gain); !fault.empty()) return fault;
    SoundPass pass{file, sound, gain};
    if (!pass.fault().empty()) return pass.fault();
    if (shape.frames == 0) shape = pass.shape();
    if (auto fault = isTold ? "" : taker.begin(shape); !fault.empty()) return fault;
    return decodeAll(pass, shape, taker);
}

} // namespace physvib
