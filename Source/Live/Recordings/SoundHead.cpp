// SPDX-License-Identifier: MIT
// Reads the headers of sound files: walks over chunks, blocks and pages without reading samples.
#include "Live/Recordings/ReadRecording.h"
#include <algorithm>
#include <sndfile.h>

namespace physvib {
namespace {

constexpr const char* notASound = "expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file";
constexpr const char* noSamples = "expected samples, found none";

class HeadReader {
public:
    HeadReader(std::FILE& file, std::int64_t bytes)
        : file_{file}
        , bytes_{bytes} {}

    Result<SoundHead> read() {
        std::int64_t at = 0;
        std::string tag = bytesAt(0, 10); // tags of MP3 stand before other kinds as well
        for (int i = 0; i < mostParts && tag.size() == 10 && tag.starts_with("ID3"); ++i) {
            std::int64_t length = 0;
            for (const char c : tag.substr(6)) length = length << 7 | (c & 127);
            tag = bytesAt(at += 10 + length, 10);
        }
        const std::string head = bytesAt(at, 12), name = head.substr(0, 4), form = head.substr(name.size());
        head_.begin = at;
        head_.bytes = bytes_ - at;
        std::string fault = notASound;
        if (name == "fLaC")
            fault = readFlac(at + 4);
        else if (name == "OggS")
            fault = readPages(at);
        else if (form.ends_with("WAVE") &&
                 (name == "RIFF" || name == "RIFX" || name == "RF64" || name == "BW64"))
            fault = readChunks(at + 12, "data", name == "RIFX", name.ends_with("64"));
        else if (name == "FORM" && (form.ends_with("AIFF") || form.ends_with("AIFC")))
            fault = readChunks(at + 12, "SSND", true, false);
        if (!fault.empty()) return Failure{std::move(fault)};
        return std::move(head_);
    }

private:
    static constexpr int mostParts = 10'000; // of a head: sounds have ten, pictures some more
    static constexpr std::int64_t fourGigabytes = std::int64_t{1} << 32;

    /// Up to `count` bytes from `at`; fewer at the end.
    std::string bytesAt(std::int64_t at, std::size_t count) {
        std::string bytes(count, '\0');
        if (at < 0 || at >= bytes_ || std::fseek(&file_, static_cast<long>(at), SEEK_SET) != 0) count = 0;
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
    Chunk chunkAt(std::int64_t at, bool isBig) {
        const std::string head = bytesAt(at, 8);
        if (head.size() < 8) return {};
        return {head.substr(0, 4), at + 8, number(std::string_view{head}.substr(4), isBig)};
    }
    /// True if chunks, of which none has samples, reach from `at` to the end, or to a few zeros or a tag of
    /// MP3 there. The last one may lack the byte that makes it even.
    bool areChunks(std::int64_t at, bool isBig) {
        for (int i = 0; i < mostParts && at < bytes_; ++i) {
            const Chunk chunk = chunkAt(at, isBig);
            const bool isName = std::ranges::all_of(chunk.name, [](char c) { return c >= ' ' && c <= '~'; });
            if (chunk.name.empty() || !isName || chunk.end() > bytes_ + 1 || chunk.name == "data") break;
            at = chunk.end();
        }
        constexpr std::int64_t sector = 65536, tagBytes = 128;
        const std::string rest = bytesAt(at, sector + 1);
        return (rest.size() == tagBytes && rest.starts_with("TAG")) ||
               (rest.size() <= sector && rest.find_first_not_of('\0') == std::string::npos);
    }

    /// Sets the number of bytes of samples; the chunk's header says `told`. Empty, or the error.
    std::string takeData(const Chunk& data, std::int64_t told, bool isBig, bool isLong) {
        // Programs that do not know the length yet write 0, nearly 2 or 4 GiB, or the largest 64-bit number.
        constexpr std::int64_t near = 1 << 16;
        const std::int64_t present = bytes_ - data.begin;
        const bool isPlaceholder =
            isLong ? told >> 56 != 0
                   : std::abs(told - fourGigabytes / 2) <= near || told >= fourGigabytes - near;
        if (told == 0 && areChunks(data.begin, isBig)) return noSamples;
        const auto bytes = dataBytes_ =
            told == 0 || (isPlaceholder && (told < 0 || told > present)) ? present : told;
        const std::string expected =
            "expected " + std::to_string(bytes) + " bytes of samples, as its header says, found ";
        if (bytes > present) return expected + std::to_string(present) + ": it ends early";
        if (bytes >= fourGigabytes && !isLong) return "expected at most 4 GiB of samples, or RF64";
        const std::int64_t end = data.begin + bytes;
        return areChunks(end + (bytes & 1), isBig) || areChunks(end, isBig)
                   ? ""
                   : expected + std::to_string(bytes_ - end) + " more, which are no other chunks";
    }

    /// Reads the chunks before the samples. Empty, or the error.
    std::string readChunks(std::int64_t at, const char* samples, bool isBig, bool isLong) {
        std::string format;
        std::int64_t longBytes = 0;
        Chunk chunk = chunkAt(at, isBig);
        for (int i = 0; i < mostParts && !chunk.name.empty() && chunk.name != samples; ++i) {
            if (chunk.name == "ds64" && isLong) longBytes = number(bytesAt(chunk.begin + 8, 8));
            const auto begins = std::min<std::int64_t>(chunk.bytes, 40); // of a format, all that we read
            if (chunk.name == "fmt ") format = bytesAt(chunk.begin, static_cast<std::size_t>(begins));
            chunk = chunkAt(chunk.end(), isBig);
        }
        if (chunk.name != samples) return noSamples;
        const bool isToldLong = isLong && (longBytes != 0 || chunk.bytes == fourGigabytes - 1);
        if (auto fault = takeData(chunk, isToldLong ? longBytes : chunk.bytes, isBig, isLong); !fault.empty())
            return fault;
        return chunk.name == "data" ? takeFormat(format, isBig, chunk.begin) : std::string{};
    }

    /// Reads how each sample stands in its block. Empty, or the error.
    std::string takeFormat(const std::string& format, bool isBig, std::int64_t begin) {
        constexpr std::int64_t pcm = 1, ieeeFloat = 3, aLaw = 6, muLaw = 7, extensible = 0xfffe;
        constexpr std::array types{SF_FORMAT_PCM_U8, SF_FORMAT_PCM_16, SF_FORMAT_PCM_24, SF_FORMAT_PCM_32};
        if (format.size() < 16) return "expected a format before the samples, of 16 bytes or more";
        const auto field = [&](std::size_t i, std::size_t width) {
            return number(std::string_view{format}.substr(i, width), isBig);
        };
        const auto channels = field(2, 2), block = field(12, 2), bits = field(14, 2), width = (bits + 7) / 8,
                   tag = field(0, 2) == extensible && format.size() == 40 ? field(24, 2) : field(0, 2);
        std::int64_t room = width;
        if (channels > 0 && tag == pcm && width >= 1 && width <= 4) {
            // Blocks that are too small for their samples are a mistake and ignored; larger ones are not.
            if (block > channels * width && width > 1 && block % channels == 0)
                room = std::min<std::int64_t>(block / channels, 4);
            head_.format = types[static_cast<std::size_t>(room) - 1];
        } else if (channels > 0 && tag == ieeeFloat && (bits == 32 || bits == 64))
            head_.format = bits == 32 ? SF_FORMAT_FLOAT : SF_FORMAT_DOUBLE;
        else if (channels > 0 && (tag == aLaw || tag == muLaw) && bits == 8)
            head_.format = tag == aLaw ? SF_FORMAT_ALAW : SF_FORMAT_ULAW;
        else
            return "expected PCM of 8 to 32 bits, float of 32 or 64, or G.711";
        head_.format |= SF_FORMAT_RAW | (isBig ? SF_ENDIAN_BIG : SF_ENDIAN_LITTLE);
        const auto frameBytes = channels * room;
        if (block > frameBytes)
            return "expected blocks of " + std::to_string(channels * width) + " bytes, found " +
                   std::to_string(block);
        head_.shape = {field(4, 4), channels, dataBytes_ / frameBytes};
        head_.begin = begin;
        head_.bytes = head_.shape.frames * frameBytes;
        head_.isSurveyed = tag == pcm && bits < 8 * room && width > 1;
        head_.bits = static_cast<int>(bits), head_.room = static_cast<int>(8 * room);
        head_.isLowRather = room > width;
        return head_.shape.frames > 0 ? "" : noSamples;
    }

    /// A description of our own, without the length, which is compared later; no other blocks.
    std::string readFlac(std::int64_t at) {
        std::string description;
        bool isLast = false;
        for (int i = 0; !isLast; ++i) {
            const std::string block = bytesAt(at, 4);
            if (block.size() < 4 || i == mostParts || (i == 0) != ((block[0] & 127) == 0))
                return i == 0 || block.size() < 4 ? notASound : "expected one description of the stream";
            if (i == 0) description = bytesAt(at + 4, 34);
            isLast = (block[0] & 128) != 0;
            at += 4 + number(std::string_view{block}.substr(1), true);
        }
        const std::string frame = bytesAt(at, 4);
        if (description.size() < 34 || frame.size() < 4) return noSamples;
        const auto numbers = number(std::string_view{description}.substr(10, 8), true);
        const auto bits = (numbers >> 36 & 31) + 1;
        head_.shape = {numbers >> 44 & 0xfffff, (numbers >> 41 & 7) + 1, numbers & 0xf'ffff'ffff};
        head_.isSurveyed = head_.shape.frames == 0;
        // libsndfile knows 8, 16 and 24 bits in the description, and all in the frames, which repeat them
        constexpr std::array bitsOfCode{0, 8, 12, 0, 16, 20, 24, 32};
        if (bitsOfCode[static_cast<std::size_t>(frame[3] >> 1 & 7)] != bits)
            return "expected 8, 12, 16, 20, 24 or 32 bits, in its description as in its frames";
        head_.head = "fLaC\x80" + std::string{"\0\0\x22", 3} + description;
        head_.head[20] = static_cast<char>((head_.head[20] & 0xfe) | 1), head_.head[21] = 0x70; // 24 bits
        std::fill_n(head_.head.begin() + 22, 4, '\0');
        head_.begin = at;
        head_.bytes = bytes_ - at;
        return {};
    }

    /// One stream of whole pages, to its last one; a decoder would leave out damaged or missing ones.
    std::string readPages(std::int64_t at) {
        constexpr int begins = 2, ends = 4;
        int streams = 0, flags = 0;
        std::int64_t next = 0;
        while (at < bytes_) {
            const std::string head = bytesAt(at, 27 + 255);
            if (head.size() < 27 || !head.starts_with("OggS")) break;
            const auto segments = static_cast<std::size_t>(static_cast<unsigned char>(head[26]));
            std::size_t length = 27 + segments;
            for (const char c : head.substr(27, segments)) length += static_cast<unsigned char>(c);
            const std::string page = bytesAt(at, length);
            flags = head[5];
            streams += (flags & begins) != 0;
            if (streams > 1) return "expected one stream of sound, found several";
            if (page.size() == length && (number(page.substr(18, 4)) != next++ || !isWholePage(page)))
                return "expected whole pages, found damage at byte " + std::to_string(at);
            at += static_cast<std::int64_t>(length);
        }
        head_.bytes = at - head_.begin;
        return at > bytes_ || (flags & ends) == 0 ? "expected the last page of its stream: it ends early"
                                                  : "";
    }

    /// True if the page has the checksum that it says: CRC-32 with the polynomial 04c11db7.
    static bool isWholePage(std::string page) {
        const auto told = number(page.substr(22, 4));
        std::fill_n(page.begin() + 22, 4, '\0');
        std::uint32_t sum = 0;
        for (const char c : page) {
            sum ^= static_cast<std::uint32_t>(static_cast<unsigned char>(c)) << 24;
            for (int bit = 0; bit < 8; ++bit) sum = sum << 1 ^ (sum >> 31) * 0x04c11db7u;
        }
        return sum == told;
    }

    std::FILE& file_;
    std::int64_t bytes_, dataBytes_ = 0;
    SoundHead head_;
};

} // namespace

Result<SoundHead> readSoundHead(std::FILE& file, std::int64_t bytes) {
    return HeadReader{file, bytes}.read();
}

} // namespace physvib
