// SPDX-License-Identifier: MIT
// Ogg Vorbis, by libvorbisfile.
#include "Live/Recordings/Decoders.h"
#include <algorithm>
#include <array>
#include <cstdint>
#define OV_EXCLUDE_STATIC_CALLBACKS
#include <string_view>
#include <vorbis/vorbisfile.h>

namespace physvib {
namespace {

/// Empty, or the error that several streams are chained: each has a rate and channels of its own.
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

/// The file, with a limit of the bytes read: the library seeks the end and goes back, and a hostile file
/// could make it do so for long.
struct LimitedFile {
    std::FILE& file;
    std::int64_t left;

    static constexpr std::int64_t mostRounds = 4;
    LimitedFile(std::FILE& stream, std::size_t bytes)
        : file{stream}
        , left{mostRounds * static_cast<std::int64_t>(bytes) + (1 << 20)} {}

    static std::size_t read(void* to, std::size_t size, std::size_t count, void* source) {
        auto& from = *static_cast<LimitedFile*>(source);
        from.left -= static_cast<std::int64_t>(size * count);
        return from.left > 0 ? std::fread(to, size, count, &from.file) : 0;
    }
    static int seek(void* source, ogg_int64_t offset, int whence) {
        return std::fseek(&static_cast<LimitedFile*>(source)->file, static_cast<long>(offset), whence);
    }
    static long tell(void* source) { return std::ftell(&static_cast<LimitedFile*>(source)->file); }
};

std::string decodeAll(OggVorbis_File& vorbis, SoundTaker& taker) {
    const vorbis_info* const info = ov_info(&vorbis, -1);
    const SoundShape shape{info->rate, info->channels, ov_pcm_total(&vorbis, -1)};
    if (auto fault = taker.begin(shape); !fault.empty()) return fault;
    std::int64_t done = 0;
    while (done < shape.frames) {
        float** samples = nullptr;
        int stream = 0;
        const long count = ov_read_float(&vorbis, &samples, 4096, &stream);
        if (count == OV_HOLE) continue; // what is damaged is missing at the end
        if (count <= 0) return endsEarly(shape.frames);
        const auto taken = std::min<std::int64_t>(count, shape.frames - done);
        if (auto fault = taker.take(samples, static_cast<int>(taken)); !fault.empty()) return fault;
        done += taken;
    }
    return {};
}

} // namespace

std::string decodeVorbis(std::FILE& file, std::size_t fileBytes, SoundTaker& taker) {
    if (auto fault = oggFault(file); !fault.empty()) return fault;
    std::rewind(&file);
    LimitedFile limited{file, fileBytes};
    OggVorbis_File vorbis{};
    if (ov_open_callbacks(&limited, &vorbis, nullptr, 0,
                          {LimitedFile::read, LimitedFile::seek, nullptr, LimitedFile::tell}) != 0)
        return notASound;
    auto fault = decodeAll(vorbis, taker);
    ov_clear(&vorbis);
    return fault;
}

} // namespace physvib
