// SPDX-License-Identifier: MIT
// WAV files whose headers say what a test wants them to say.
#pragma once
#include <cstdint>
#include <string>

namespace physvib::test {

struct WavHeader {
    std::uint32_t format = 1; ///< 1: PCM, 3: float, 0xfffe: extensible, as PCM
    std::uint32_t channels = 1;
    std::uint32_t rateHz = 48000;
    std::uint32_t bits = 16;
    std::uint32_t dataBytes = 0;  ///< that the header claims; 0: as many as there are
    std::uint32_t frameBytes = 0; ///< that it claims; 0: as many as the bits need
    std::string kind = "RIFF";    ///< RF64, BW64: sizes in 64 bits; RIFX: the other order of bytes
    std::string before{};         ///< chunks before the samples
};

inline std::string numberBytes(std::uint64_t value, int width, bool isBig = false) {
    std::string bytes;
    for (int i = 0; i < width; ++i)
        bytes += static_cast<char>(value >> (8 * (isBig ? width - 1 - i : i)) & 255);
    return bytes;
}

/// Its samples begin at byte 44, if it is plain RIFF.
inline std::string wavBytes(const WavHeader& header, const std::string& samples) {
    const bool isBig = header.kind == "RIFX", isLong = header.kind.ends_with("64");
    const auto number = [&](std::uint64_t value, int width) { return numberBytes(value, width, isBig); };
    const std::uint64_t data = header.dataBytes > 0 ? header.dataBytes : samples.size();
    const std::uint32_t frame =
        header.frameBytes > 0 ? header.frameBytes : header.channels * ((header.bits + 7) / 8);
    std::string bytes = "WAVE";
    if (isLong) bytes += "ds64" + number(28, 4) + number(data + 72, 8) + number(data, 8) + number(0, 12);
    bytes += "fmt " + number(header.format == 0xfffe ? 40 : 16, 4) + number(header.format, 2) +
             number(header.channels, 2) + number(header.rateHz, 4) +
             number(std::uint64_t{header.rateHz} * frame, 4) + number(frame, 2) + number(header.bits, 2);
    if (header.format == 0xfffe)
        bytes += number(22, 2) + number(header.bits, 2) + number(0, 4) + number(1, 2) +
                 std::string{"\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71", 14};
    bytes += header.before + "data" + number(isLong ? 0xffffffffu : data, 4);
    return header.kind + number(isLong ? 0xffffffffu : bytes.size() + data, 4) + bytes + samples;
}

} // namespace physvib::test
