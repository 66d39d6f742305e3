// SPDX-License-Identifier: MIT
// Writes the converter codes as a WAV file: 8 bit, four channels, one sample per frame.
#pragma once
#include "Converters.h"
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace physvib::virtualboard {

/// False if the file cannot be written. `rate`: frames per second.
inline bool writeWav(const std::string& path, const std::vector<Converters::Frame>& frames,
                     std::uint32_t rate) {
    std::ofstream out(path, std::ios::binary);
    const auto number = [&out](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) out.put(static_cast<char>(value >> (8 * i)));
    };
    const auto size = static_cast<std::uint32_t>(frames.size() * 4);
    out << "RIFF";
    number(36 + size, 4);
    out << "WAVEfmt ";
    number(16, 4), number(1, 2), number(4, 2), number(rate, 4), number(rate * 4, 4), number(4, 2),
        number(8, 2);
    out << "data";
    number(size, 4);
    for (const auto& frame : frames)
        for (const std::uint8_t code : frame) out.put(static_cast<char>(code));
    out.flush();
    return out.good();
}

} // namespace physvib::virtualboard
