// SPDX-License-Identifier: MIT
// WAV parser, chunk by chunk; reads only format and data, and allocates no more than the file's size
// justifies.
#include "Io/Wav/WavFile.h"
#include <algorithm>
#include <bit>
#include <span>
#include <utility>
#include <vector>

namespace physvib {

namespace {

constexpr std::size_t blockFrames = 4096;
constexpr std::uint64_t unknownLength = 0x7fff0000; // files written to a pipe have no known length; programs
                                                    // write this value, or more

class WavReader {
public:
    explicit WavReader(std::FILE& file)
        : file_{file} {}

    std::string read(SoundTaker& taker) {
        if (!readHeader() || !findData()) return error_;
        const SoundShape shape{rateHz_, channels_, static_cast<std::int64_t>(dataBytes_ / frameBytes())};
        if (auto fault = taker.begin(shape); !fault.empty()) return fault;
        return takeSamples(static_cast<std::size_t>(shape.frames), taker);
    }

private:
    std::uint64_t frameBytes() const noexcept { return static_cast<std::uint64_t>(channels_) * bits_ / 8; }

    bool take(std::span<unsigned char> bytes) {
        return std::fread(bytes.data(), 1, bytes.size(), &file_) == bytes.size();
    }
    std::uint64_t number(int bytes) { // little-endian; 0 beyond the end, where all loops stop
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i)
            value |= static_cast<std::uint64_t>(std::max(0, std::fgetc(&file_))) << (8 * i);
        return value;
    }
    bool takeName() { return std::fread(name_, 1, 4, &file_) == 4; }
    bool isNamed(std::string_view wanted) const noexcept { return std::string_view(name_, 4) == wanted; }
    bool fail(std::string error) {
        error_ = std::move(error);
        return false;
    }

    bool readHeader() {
        if (std::fseek(&file_, 0, SEEK_END) != 0) return fail("cannot be read");
        size_ = static_cast<std::uint64_t>(std::max(0l, std::ftell(&file_)));
        std::rewind(&file_);
        if (!takeName() || !(isNamed("RIFF") || isNamed("RF64"))) return fail("expected a WAV file");
        number(4); // RIFF length: ignored in favour of the file's size
        return (takeName() && isNamed("WAVE")) || fail("expected a WAV file");
    }

    /// Seeks to the first sample.
    bool findData() {
        while (takeName()) {
            std::uint64_t bytes = number(4);
            const auto begin = static_cast<std::uint64_t>(std::ftell(&file_));
            if (isNamed("data")) return beginData(begin, longBytes_ > 0 ? longBytes_ : bytes);
            if (isNamed("ds64")) longBytes_ = (number(8), number(8));
            if (isNamed("fmt ") && !readFormat(bytes)) return false;
            bytes += bytes & 1;
            if (bytes > size_ - std::min(size_, begin)) break;
            std::fseek(&file_, static_cast<long>(begin + bytes), SEEK_SET);
        }
        return fail("expected samples, found none");
    }

    bool readFormat(std::uint64_t bytes) {
        constexpr std::uint64_t pcm = 1, ieeeFloat = 3, extensible = 0xfffe;
        std::uint64_t format = number(2);
        channels_ = static_cast<std::int64_t>(number(2));
        rateHz_ = static_cast<std::int64_t>(number(4));
        number(6); // bytes per second and per frame: redundant
        bits_ = number(2);
        // the rest of the GUID is constant
        if (format == extensible && bytes >= 40) format = (number(8), number(2));
        isFloat_ = format == ieeeFloat;
        const bool isKnown = isFloat_
                                 ? bits_ == 32
                                 : format == pcm && (bits_ == 8 || bits_ == 16 || bits_ == 24 || bits_ == 32);
        return (isKnown && channels_ > 0) || fail("expected PCM of 8, 16, 24 or 32 bits, or float of 32");
    }

    bool beginData(std::uint64_t begin, std::uint64_t bytes) {
        if (channels_ == 0) return fail("expected a format before the samples");
        const std::uint64_t present = size_ - std::min(size_, begin);
        dataBytes_ = std::min(bytes, present);
        return bytes <= present || bytes >= unknownLength ||
               fail("expected " + std::to_string(bytes) + " bytes of samples, as its header says, found " +
                    std::to_string(present) + ": it ends early");
    }

    std::string takeSamples(std::size_t frames, SoundTaker& taker) {
        std::vector<unsigned char> block(frameBytes() * blockFrames);
        std::vector<std::vector<float>> samples(static_cast<std::size_t>(channels_),
                                                std::vector<float>(blockFrames));
        std::vector<const float*> at;
        for (const auto& channel : samples) at.push_back(channel.data());
        for (std::size_t done = 0; done < frames;) {
            const std::size_t count = std::min<std::size_t>(blockFrames, frames - done);
            if (!take({block.data(), count * frameBytes()})) return "cannot be read to its end";
            const unsigned char* from = block.data();
            for (std::size_t i = 0; i < count; ++i)
                for (auto& channel : samples) channel[i] = sample(from);
            if (auto fault = taker.take(at.data(), static_cast<int>(count)); !fault.empty()) return fault;
            done += count;
        }
        return {};
    }

    /// Reads the next sample and advances.
    float sample(const unsigned char*& from) const noexcept {
        std::uint32_t high = 0; // its bits are the most significant
        for (std::uint64_t i = 4 - bits_ / 8; i < 4; ++i)
            high |= static_cast<std::uint32_t>(*from++) << (8 * i);
        if (isFloat_) return std::bit_cast<float>(high);
        if (bits_ == 8) high ^= 0x80000000; // the only unsigned format
        return static_cast<float>(static_cast<std::int32_t>(high)) * 0x1p-31f;
    }

    std::FILE& file_;
    char name_[4] = {};
    std::uint64_t size_ = 0, longBytes_ = 0, dataBytes_ = 0, bits_ = 0;
    std::int64_t channels_ = 0, rateHz_ = 0;
    bool isFloat_ = false;
    std::string error_;
};

std::int64_t numberAt(std::string_view bytes, std::size_t at, std::size_t width) noexcept {
    std::int64_t value = 0;
    for (std::size_t i = width; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

} // namespace

std::string streamWav(std::FILE& file, SoundTaker& taker) { return WavReader{file}.read(taker); }

std::int64_t wavFileBytes(std::string_view head) noexcept {
    constexpr std::size_t idBytes = 4, longSizeAt = 20; // of RF64, in its chunk ds64
    if (head.size() < wavSizeBytes) return 0;
    if (head.starts_with("RIFF")) return 8 + numberAt(head, idBytes, 4);
    return head.starts_with("RF64") ? 8 + numberAt(head, longSizeAt, 8) : 0;
}

} // namespace physvib
