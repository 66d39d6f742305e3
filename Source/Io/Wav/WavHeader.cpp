// SPDX-License-Identifier: MIT
// Builds WAV headers. RIFF and RF64 headers have equal length, so samples always begin at one position.
#include "Io/Wav/WavHeader.h"
#include "Io/Text/CleanText.h"
#include <utility>

namespace physvib {
namespace {

constexpr std::int64_t rf64Bytes = std::int64_t{1} << 32;

void appendInt(std::string& bytes, std::int64_t value, int byteCount) {
    for (int i = 0; i < byteCount; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
}

std::string makeChunk(const std::string& name, std::string content) {
    std::string bytes = name;
    content.append(content.size() & 1, '\0');
    appendInt(bytes, std::ssize(content), 4);
    return bytes + content;
}

std::string formatChunk(int channels, int sampleRateHz, bool isExtensible) {
    constexpr char floatSubFormat[] = "\x03\0\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71";
    const std::int64_t frameBytes = channels * 4;
    std::string content;
    appendInt(content, isExtensible ? 0xfffe : 3, 2);
    appendInt(content, channels, 2);
    appendInt(content, sampleRateHz, 4);
    appendInt(content, sampleRateHz * frameBytes, 4);
    appendInt(content, frameBytes, 2);
    appendInt(content, 32, 2);
    if (isExtensible) {
        appendInt(content, 22, 2); // bytes that follow
        appendInt(content, 32, 2); // valid bits
        appendInt(content, 0, 4);  // speaker mask: none
        content.append(floatSubFormat, 16);
    }
    return makeChunk("fmt ", content);
}

} // namespace

std::string wavInfoChunk(const std::string& comment) {
    if (comment.empty()) return {};
    std::string samplerChunk(60, '\0'); // sampler chunk with middle C (60) and no loops, which files with
                                        // a comment have always had: their bytes must not change
    samplerChunk[12] = 60;
    return makeChunk("smpl", std::move(samplerChunk)) +
           makeChunk("LIST", "INFO" + makeChunk("ICMT", cleanLine(comment) + '\0'));
}

// The chunk for 64-bit sizes, or padding of its length, comes first. It is longer before the shorter, plain
// format chunk.
std::string wavHeader(int channels, int sampleRateHz, std::int64_t dataBytes, const std::string& infoChunk) {
    const std::int64_t riffBytes = wavHeaderBytes - 8 + std::ssize(infoChunk) + dataBytes;
    const bool isRf64 = riffBytes >= rf64Bytes, isExtensible = isRf64 || channels > 2;
    std::string sizes;
    if (isRf64) {
        appendInt(sizes, riffBytes, 8);
        appendInt(sizes, dataBytes, 8);
    }
    sizes.resize(isExtensible ? 28 : 52);
    std::string bytes = isRf64 ? "RF64" : "RIFF";
    appendInt(bytes, isRf64 ? -1 : riffBytes, 4);
    bytes += "WAVE" + makeChunk(isRf64 ? "ds64" : "JUNK", sizes) +
             formatChunk(channels, sampleRateHz, isExtensible) + infoChunk + "data";
    appendInt(bytes, isRf64 ? -1 : dataBytes, 4);
    return bytes;
}

} // namespace physvib
