// SPDX-License-Identifier: MIT
// FLAC, by libFLAC.
#include "Live/Recordings/Decoders.h"
#include <FLAC/stream_decoder.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace physvib {
namespace {

/// The file's own description. Or why it is refused: several descriptions, or no length, of which decoders
/// make different things.
std::string readShape(std::FILE& file, SoundShape& shape) {
    std::array<unsigned char, 42> head{}; // "fLaC", a block header, the stream description
    if (std::fread(head.data(), 1, head.size(), &file) != head.size() || (head[4] & 0x7f) != 0)
        return notASound;
    const auto at = [&](std::size_t i) { return static_cast<std::int64_t>(head[i]); };
    shape = {at(18) << 12 | at(19) << 4 | at(20) >> 4, (at(20) >> 1 & 7) + 1,
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

struct Decoding {
    std::FILE& file;
    SoundTaker& taker;
    SoundShape shape;
    std::int64_t done = 0;
    std::string fault{};
    std::vector<std::vector<float>> block{};
    std::vector<const float*> at{};

    bool take(const FLAC__Frame& frame, const FLAC__int32* const* samples) {
        const auto& head = frame.header;
        const auto count = std::min<std::int64_t>(head.blocksize, shape.frames - done);
        if (head.channels != block.size() || head.bits_per_sample < 1 || head.bits_per_sample > 32)
            return fault = notASound, false;
        // as integers of 32 bits, of which the largest is 1
        const auto scale = static_cast<float>(std::int64_t{1} << (32 - head.bits_per_sample));
        for (std::size_t j = 0; j < block.size(); ++j) {
            block[j].resize(head.blocksize);
            std::transform(samples[j], samples[j] + count, block[j].begin(), [scale](FLAC__int32 x) {
                return scale * static_cast<float>(x) * (1.0f / static_cast<float>(INT32_MAX));
            });
            at[j] = block[j].data();
        }
        done += count;
        if (count > 0) fault = taker.take(at.data(), static_cast<int>(count));
        return fault.empty();
    }
};

FLAC__StreamDecoderReadStatus read(const FLAC__StreamDecoder*, FLAC__byte* to, size_t* bytes, void* client) {
    *bytes = std::fread(to, 1, *bytes, &static_cast<Decoding*>(client)->file);
    return *bytes > 0 ? FLAC__STREAM_DECODER_READ_STATUS_CONTINUE
                      : FLAC__STREAM_DECODER_READ_STATUS_END_OF_STREAM;
}

FLAC__StreamDecoderWriteStatus write(const FLAC__StreamDecoder*, const FLAC__Frame* frame,
                                     const FLAC__int32* const samples[], void* client) {
    return static_cast<Decoding*>(client)->take(*frame, samples) ? FLAC__STREAM_DECODER_WRITE_STATUS_CONTINUE
                                                                 : FLAC__STREAM_DECODER_WRITE_STATUS_ABORT;
}

// what is damaged is missing at the end
void ignore(const FLAC__StreamDecoder*, FLAC__StreamDecoderErrorStatus, void*) {}

} // namespace

std::string endsEarly(std::int64_t frames) {
    return "expected " + std::to_string(frames) +
           " samples in each channel, as its header says: it ends early";
}

std::string decodeFlac(std::FILE& file, SoundTaker& taker) {
    SoundShape shape;
    if (auto fault = readShape(file, shape); !fault.empty()) return fault;
    if (auto fault = taker.begin(shape); !fault.empty()) return fault;
    std::rewind(&file);
    const std::unique_ptr<FLAC__StreamDecoder, decltype(&FLAC__stream_decoder_delete)> decoder{
        FLAC__stream_decoder_new(), FLAC__stream_decoder_delete};
    const auto channels = static_cast<std::size_t>(shape.channels);
    Decoding decoding{file, taker, shape};
    decoding.block.resize(channels);
    decoding.at.resize(channels);
    if (!decoder ||
        FLAC__stream_decoder_init_stream(decoder.get(), read, nullptr, nullptr, nullptr, nullptr, write,
                                         nullptr, ignore, &decoding) != FLAC__STREAM_DECODER_INIT_STATUS_OK)
        return notASound;
    FLAC__stream_decoder_process_until_end_of_stream(decoder.get());
    if (!decoding.fault.empty()) return decoding.fault;
    return decoding.done == shape.frames ? std::string{} : endsEarly(shape.frames);
}

} // namespace physvib
