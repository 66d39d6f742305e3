// SPDX-License-Identifier: MIT
// Little-endian numbers in their order.
#include "Files/WavHead.h"

namespace physvib {

namespace {

void add(std::string& bytes, std::uint32_t value, int width) {
    for (int i = 0; i < width; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
}

std::int64_t numberAt(std::string_view bytes, std::size_t at, std::size_t width) noexcept {
    std::int64_t value = 0;
    for (std::size_t i = width; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

} // namespace

std::string wavFormatChunk(int channels, int sampleRateHz) {
    constexpr char floatFormat[] = "\x03\0\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71";
    const bool isExtensible = channels > 2;
    const auto count = static_cast<std::uint32_t>(channels), rate = static_cast<std::uint32_t>(sampleRateHz), frameBytes = count * 4;
    std::string bytes = "fmt ";
    add(bytes, isExtensible ? 40 : 16, 4);
    add(bytes, isExtensible ? 0xfffe : 3, 2);
    add(bytes, count, 2);
    add(bytes, rate, 4);
    add(bytes, rate * frameBytes, 4);
    add(bytes, frameBytes, 2);
    add(bytes, 32, 2);
    if (!isExtensible) return bytes;
    add(bytes, 22, 2); // bytes that follow
    add(bytes, 32, 2); // valid bits
    add(bytes, 0, 4);  // no speakers
    return bytes.append(floatFormat, 16);
}

std::string wavHead(int channels, int sampleRateHz, std::uint32_t dataBytes) {
    const std::string format = wavFormatChunk(channels, sampleRateHz);
    std::string bytes = "RIFF";
    add(bytes, static_cast<std::uint32_t>(4 + format.size() + 8) + dataBytes, 4);
    bytes += "WAVE" + format + "data";
    add(bytes, dataBytes, 4);
    return bytes;
}

std::int64_t wavFileBytes(std::string_view head) noexcept {
    constexpr std::size_t idBytes = 4, longSizeAt = 20; // of RF64, in its chunk ds64
    if (head.size() < wavSizeBytes) return 0;
    if (head.starts_with("RIFF")) return 8 + numberAt(head, idBytes, 4);
    return head.starts_with("RF64") ? 8 + numberAt(head, longSizeAt, 8) : 0;
}

} // namespace physvib
