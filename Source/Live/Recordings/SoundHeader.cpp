// SPDX-License-Identifier: MIT
// Reads the headers of sound files: walks over chunks, blocks and pages without reading samples.
#include "Live/Recordings/ReadRecording.h"
#include <algorithm>
#include <sndfile.h>

namespace physvib {
namespace {

constexpr const char* notASoundError = "expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file";
constexpr const char* noSamplesError = "expected samples, found none";

class HeaderReader {
public:
    HeaderReader(std::FILE& file, std::int64_t bytes)
        : file_{file}
        , bytes_{bytes} {}

    Result<SoundHeader> read() {
        std::int64_t offset = 0;
        std::string tag = readBytes(0, 10); // tags of MP3 stand before other kinds as well
        for (int i = 0; i < maxHeaderParts && tag.size() == 10 && tag.starts_with("ID3"); ++i) {
            std::int64_t length = 0;
            for (const char c : tag.substr(6)) length = length << 7 | (c & 127);
            tag = readBytes(offset += 10 + length, 10);
        }
        const std::string head = readBytes(offset, 12), name = head.substr(0, 4),
                          form = head.substr(name.size());
        head_.begin = offset;
        head_.bytes = bytes_ - offset;
        std::string error = notASoundError;
        if (name == "fLaC")
            error = readFlac(offset + 4);
        else if (name == "OggS")
            error = readPages(offset);
        else if (form.ends_with("WAVE") &&
                 (name == "RIFF" || name == "RIFX" || name == "RF64" || name == "BW64"))
            error = readChunks(offset + 12, "data", name == "RIFX", name.ends_with("64"));
        else if (name == "FORM" && (form.ends_with("AIFF") || form.ends_with("AIFC")))
            error = readChunks(offset + 12, "SSND", true, false);
        if (!error.empty()) return Failure{std::move(error)};
        return std::move(head_);
    }

private:
    static constexpr int maxHeaderParts = 10'000; // limit for chunks of a header: sounds have ten
    static constexpr std::int64_t fourGigabytes = std::int64_t{1} << 32;

    /// Up to `count` bytes from `offset`; fewer at the end.
    std::string readBytes(std::int64_t offset, std::size_t count) {
        std::string bytes(count, '\0');
        if (offset < 0 || offset >= bytes_ || std::fseek(&file_, static_cast<long>(offset), SEEK_SET) != 0)
            count = 0;
        bytes.resize(std::fread(bytes.data(), 1, count, &file_));
        return bytes;
    }
    static std::int64_t number(std::string_view bytes, bool isBig = false) noexcept {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < bytes.size(); ++i)
            value = value << 8 | static_cast<unsigned char>(bytes[isBig ? i : bytes.size() - 1 - i]);
        return static_cast<std::int64_t>(value);
    }

    struct Chunk {
        std::string name;
        std::int64_t begin = 0, bytes = 0;
        std::int64_t end() const noexcept { return begin + bytes + (bytes & 1); }
    };
    Chunk chunkAt(std::int64_t offset, bool isBig) {
        const std::string head = readBytes(offset, 8);
        if (head.size() < 8) return {};
        return {head.substr(0, 4), offset + 8, number(std::string_view{head}.substr(4), isBig)};
    }
    /// True if chunks, of which none has samples, reach from `offset` to the end, or to a few zeros or a tag
    /// of MP3 there. The last one may lack the byte that makes it even.
    bool areChunks(std::int64_t offset, bool isBig) {
        for (int i = 0; i < maxHeaderParts && offset < bytes_; ++i) {
            const Chunk chunk = chunkAt(offset, isBig);
            const bool isName = std::ranges::all_of(chunk.name, [](char c) { return c >= ' ' && c <= '~'; });
            if (chunk.name.empty() || !isName || chunk.end() > bytes_ + 1 || chunk.name == "data") break;
            offset = chunk.end();
        }
        constexpr std::int64_t sector = 65536, tagBytes = 128;
        const std::string remaining = readBytes(offset, sector + 1);
        return (remaining.size() == tagBytes && remaining.starts_with("TAG")) ||
               (remaining.size() <= sector && remaining.find_first_not_of('\0') == std::string::npos);
    }

    /// Sets the number of bytes of samples; the chunk's header says `declared`. Empty, or the error.
    std::string readData(const Chunk& data, std::int64_t declared, bool isBig, bool is64Bit) {
        // Programs that do not know the length yet write 0, nearly 2 or 4 GiB, or the largest 64-bit number.
        constexpr std::int64_t margin = 1 << 16;
        const std::int64_t present = bytes_ - data.begin;
        const bool isPlaceholder =
            is64Bit ? declared >> 56 != 0
                    : std::abs(declared - fourGigabytes / 2) <= margin || declared >= fourGigabytes - margin;
        if (declared == 0 && areChunks(data.begin, isBig)) return noSamplesError;
        const auto bytes = dataBytes_ =
            declared == 0 || (isPlaceholder && (declared < 0 || declared > present)) ? present : declared;
        const std::string expected =
            "expected " + std::to_string(bytes) + " bytes of samples, as its header says, found ";
        if (bytes > present) return expected + std::to_string(present) + ": it ends early";
        if (bytes >= fourGigabytes && !is64Bit) return "expected at most 4 GiB of samples, or RF64";
        const std::int64_t end = data.begin + bytes;
        return areChunks(end + (bytes & 1), isBig) || areChunks(end, isBig)
                   ? ""
                   : expected + std::to_string(bytes_ - end) + " more, which are no other chunks";
    }

    /// Reads the chunks before the samples. Empty, or the error.
    std::string readChunks(std::int64_t offset, const char* samples, bool isBig, bool is64Bit) {
        std::string format;
        std::int64_t bytes64 = 0;
        Chunk chunk = chunkAt(offset, isBig);
        for (int i = 0; i < maxHeaderParts && !chunk.name.empty() && chunk.name != samples; ++i) {
            if (chunk.name == "ds64" && is64Bit) bytes64 = number(readBytes(chunk.begin + 8, 8));
            const auto usedBytes = std::min<std::int64_t>(chunk.bytes, 40); // of a format, all that we read
            if (chunk.name == "fmt ") format = readBytes(chunk.begin, static_cast<std::size_t>(usedBytes));
            chunk = chunkAt(chunk.end(), isBig);
        }
        if (chunk.name != samples) return noSamplesError;
        const bool uses64Bits = is64Bit && (bytes64 != 0 || chunk.bytes == fourGigabytes - 1);
        if (auto error = readData(chunk, uses64Bits ? bytes64 : chunk.bytes, isBig, is64Bit); !error.empty())
            return error;
        return chunk.name == "data" ? readFormat(format, isBig, chunk.begin) : std::string{};
    }

    /// Reads how each sample stands in its block. Empty, or the error.
    std::string readFormat(const std::string& format, bool isBig, std::int64_t begin) {
        constexpr std::int64_t pcm = 1, ieeeFloat = 3, aLaw = 6, muLaw = 7, extensible = 0xfffe;
        constexpr std::array types{SF_FORMAT_PCM_U8, SF_FORMAT_PCM_16, SF_FORMAT_PCM_24, SF_FORMAT_PCM_32};
        if (format.size() < 16) return "expected a format before the samples, of 16 bytes or more";
        const auto field = [&](std::size_t i, std::size_t width) {
            return number(std::string_view{format}.substr(i, width), isBig);
        };
        const auto channels = field(2, 2), block = field(12, 2), bits = field(14, 2), width = (bits + 7) / 8,
                   tag = field(0, 2) == extensible && format.size() == 40 ? field(24, 2) : field(0, 2);
        std::int64_t containerBytes = width;
        if (channels > 0 && tag == pcm && width >= 1 && width <= 4) {
            // Blocks that are too small for their samples are a mistake and ignored; larger ones are not.
            if (block > channels * width && width > 1 && block % channels == 0)
                containerBytes = std::min<std::int64_t>(block / channels, 4);
            head_.format = types[static_cast<std::size_t>(containerBytes) - 1];
        } else if (channels > 0 && tag == ieeeFloat && (bits == 32 || bits == 64))
            head_.format = bits == 32 ? SF_FORMAT_FLOAT : SF_FORMAT_DOUBLE;
        else if (channels > 0 && (tag == aLaw || tag == muLaw) && bits == 8)
            head_.format = tag == aLaw ? SF_FORMAT_ALAW : SF_FORMAT_ULAW;
        else
            return "expected PCM of 8 to 32 bits, float of 32 or 64, or G.711";
        head_.format |= SF_FORMAT_RAW | (isBig ? SF_ENDIAN_BIG : SF_ENDIAN_LITTLE);
        const auto frameBytes = channels * containerBytes;
        if (block > frameBytes)
            return "expected blocks of " + std::to_string(channels * width) + " bytes, found " +
                   std::to_string(block);
        head_.shape = {field(4, 4), channels, dataBytes_ / frameBytes};
        head_.begin = begin;
        head_.bytes = head_.shape.frames * frameBytes;
        head_.needsScan = tag == pcm && bits < 8 * containerBytes && width > 1;
        head_.bits = static_cast<int>(bits), head_.containerBits = static_cast<int>(8 * containerBytes);
        head_.isLowAligned = containerBytes > width;
        return head_.shape.frames > 0 ? "" : noSamplesError;
    }

    /// Replaces the metadata by one description without a length, which is compared later.
    std::string readFlac(std::int64_t offset) {
        std::string description;
        bool isLast = false;
        for (int i = 0; !isLast; ++i) {
            const std::string block = readBytes(offset, 4);
            if (block.size() < 4 || i == maxHeaderParts || (i == 0) != ((block[0] & 127) == 0))
                return i == 0 || block.size() < 4 ? notASoundError : "expected one description of the stream";
            if (i == 0) description = readBytes(offset + 4, 34);
            isLast = (block[0] & 128) != 0;
            offset += 4 + number(std::string_view{block}.substr(1), true);
        }
        const std::string frame = readBytes(offset, 4);
        if (description.size() < 34 || frame.size() < 4) return noSamplesError;
        const auto packed = number(std::string_view{description}.substr(10, 8), true);
        const auto bits = (packed >> 36 & 31) + 1;
        head_.shape = {packed >> 44 & 0xfffff, (packed >> 41 & 7) + 1, packed & 0xf'ffff'ffff};
        head_.needsScan = head_.shape.frames == 0;
        // libsndfile knows 8, 16 and 24 bits in the description, and all in the frames, which repeat them
        constexpr std::array bitsOfCode{0, 8, 12, 0, 16, 20, 24, 32};
        if (bitsOfCode[static_cast<std::size_t>(frame[3] >> 1 & 7)] != bits)
            return "expected 8, 12, 16, 20, 24 or 32 bits, in its description as in its frames";
        head_.head = "fLaC\x80" + std::string{"\0\0\x22", 3} + description;
        head_.head[20] = static_cast<char>((head_.head[20] & 0xfe) | 1), head_.head[21] = 0x70; // 24 bits
        std::fill_n(head_.head.begin() + 22, 4, '\0');
        head_.begin = offset;
        head_.bytes = bytes_ - offset;
        return {};
    }

    /// Checks that all pages are whole and of one stream; a decoder would skip damaged ones.
    std::string readPages(std::int64_t offset) {
        constexpr int firstPage = 2, lastPage = 4;
        int streams = 0, flags = 0;
        std::int64_t next = 0;
        while (offset < bytes_) {
            const std::string head = readBytes(offset, 27 + 255);
            if (head.size() < 27 || !head.starts_with("OggS")) break;
            const auto segments = static_cast<std::size_t>(static_cast<unsigned char>(head[26]));
            std::size_t length = 27 + segments;
            for (const char c : head.substr(27, segments)) length += static_cast<unsigned char>(c);
            const std::string page = readBytes(offset, length);
            flags = head[5];
            streams += (flags & firstPage) != 0;
            if (streams > 1) return "expected one stream of sound, found several";
            if (page.size() == length && (number(page.substr(18, 4)) != next++ || !hasValidChecksum(page)))
                return "expected whole pages, found damage at byte " + std::to_string(offset);
            offset += static_cast<std::int64_t>(length);
        }
        head_.bytes = offset - head_.begin;
        return offset > bytes_ || (flags & lastPage) == 0
                   ? "expected the last page of its stream: it ends early"
                   : "";
    }

    /// True if the page has the checksum that it says: CRC-32 with the polynomial 04c11db7.
    static bool hasValidChecksum(std::string page) {
        const auto declared = number(page.substr(22, 4));
        std::fill_n(page.begin() + 22, 4, '\0');
        std::uint32_t crc = 0;
        for (const char c : page) {
            crc ^= static_cast<std::uint32_t>(static_cast<unsigned char>(c)) << 24;
            for (int bit = 0; bit < 8; ++bit) crc = crc << 1 ^ (crc >> 31) * 0x04c11db7u;
        }
        return crc == declared;
    }

    std::FILE& file_;
    std::int64_t bytes_, dataBytes_ = 0;
    SoundHeader head_;
};

} // namespace

Result<SoundHeader> readSoundHeader(std::FILE& file, std::int64_t bytes) {
    return HeaderReader{file, bytes}.read();
}

} // namespace physvib
