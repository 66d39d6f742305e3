// SPDX-License-Identifier: MIT
// WAV files whose headers say what a test wants them to say.
#pragma once
#include <cstdint>
#include <string>

namespace physvib::test {

struct WavHeader {
    std::uint32_t format = 1; ///< 1: PCM, 3: float
    std::uint32_t channels = 1;
    std::uint32_t rateHz = 48000;
    std::uint32_t bits = 16;
    std::uint32_t dataBytes = 0; ///< that the header claims; 0: as many as there are
};

/// Its samples begin at byte 44.
inline std::string wavBytes(const WavHeader& header, const std::string& samples) {
    std::string bytes;
    const auto number = [&](std::uint32_t value, int width) {
        for (int i = 0; i < width; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
    };
    const std::uint32_t data = header.dataBytes > 0 ? header.dataBytes
                                                    : static_cast<std::uint32_t>(samples.size()),
                        frame = header.channels * header.bits / 8;
    bytes += "RIFF";
    number(data + 36, 4);
    bytes += "WAVEfmt ";
    number(16, 4);
    number(header.format, 2);
    number(header.channels, 2);
    number(header.rateHz, 4);
    number(header.rateHz * frame, 4);
    number(frame, 2);
    number(header.bits, 2);
    bytes += "data";
    number(data, 4);
    return bytes + samples;
}

} // namespace physvib::test
