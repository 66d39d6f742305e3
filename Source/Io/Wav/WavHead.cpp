// SPDX-License-Identifier: MIT
// Writes WAV headers; RIFF and RF64 headers have equal length.
#include "Io/Wav/WavHead.h"
#include "Io/Text/CleanText.h"
#include <utility>

namespace physvib {
namespace {

constexpr std::int64_t rf64Bytes = std::int64_t{1} << 32;

void add(std::string& bytes, std::int64_t value, int width) {
    for (int i = 0; i < width; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
}

std::string chunk(const std::string& name, std::string content) {
    std::string bytes = name;
    content.append(content.size() & 1, '\0');
    add(bytes, std::ssize(content), 4);
    return bytes + content;
}

std::string formatChunk(int channels, int sampleRateHz, bool isExtensible) {
    constexpr char floatFormat[] = "\x03\0\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71";
    const std::int64_t frameBytes = channels * 4;
    std::string content;
    add(content, isExtensible ? 0xfffe : 3, 2);
    add(content, channels, 2);
    add(content, sampleRateHz, 4);
    add(content, sampleRateHz * frameBytes, 4);
    add(content, frameBytes, 2);
    add(content, 32, 2);
    if (isExtensible) {
        add(content, 22, 2); // bytes that follow
        add(content, 32, 2); // valid bits
        add(content, 0, 4);  // no speakers
        content.append(floatFormat, 16);
    }
    return chunk("fmt ", content);
}

} // namespace

std::string wavInfo(const std::string& comment) {
    if (comment.empty()) return {};
    std::string sampler(60, '\0'); // sampler chunk with middle C and no loops, as JUCE wrote it for files
                                   // with a comment, so that their bytes stay the same
    sampler[12] = 60;
    return chunk("smpl", std::move(sampler)) +
           chunk("LIST", "INFO" + chunk("ICMT", cleanLine(comment) + '\0'));
}

// The chunk for 64-bit sizes, or padding of its length, comes first. A plain format chunk is shorter, so the
// padding is longer.
std::string wavHead(int channels, int sampleRateHz, std::int64_t dataBytes, const std::string& info) {
    const bool isLong = dataBytes >= rf64Bytes, isExtensible = isLong || channels > 2;
    const std::int64_t riffBytes = wavHeadBytes - 8 + std::ssize(info) + dataBytes;
    std::string counts;
    if (isLong) {
        add(counts, riffBytes, 8);
        add(counts, dataBytes, 8);
    }
    counts.resize(isExtensible ? 28 : 52);
    std::string bytes = isLong ? "RF64" : "RIFF";
    add(bytes, isLong ? -1 : riffBytes, 4);
    bytes += "WAVE" + chunk(isLong ? "ds64" : "JUNK", counts) +
             formatChunk(channels, sampleRateHz, isExtensible) + info + "data";
    add(bytes, isLong ? -1 : dataBytes, 4);
    return bytes;
}

} // namespace physvib
