// SPDX-License-Identifier: GPL-3.0-or-later
// What the programs read of sound files, for sounds.py: physvib-sound-kinds < PATHS. A line for each path:
// "ok RATE CHANNELS FRAMES CHECKSUM", the CRC-32 of the interleaved floats; or the error.
#include "Live/Recordings/ReadRecording.h"
#include <bit>
#include <cstdint>
#include <iostream>

int main() {
    for (std::string path; std::getline(std::cin, path);) {
        const auto sound = physvib::readRecording(path);
        if (!sound) {
            std::cout << sound.error << '\n';
            continue;
        }
        const auto& channels = sound.value.channels;
        std::uint32_t sum = ~0u;
        for (std::size_t n = 0; n < channels.front().size(); ++n)
            for (const auto& channel : channels)
                for (std::uint32_t i = 0, bits = std::bit_cast<std::uint32_t>(channel[n]); i < 4;
                     ++i, bits >>= 8) {
                    sum ^= bits & 255;
                    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1) * 0xedb88320u;
                }
        std::cout << "ok " << sound.value.sampleRateHz << ' ' << channels.size() << ' '
                  << channels.front().size() << ' ' << ~sum << '\n';
    }
}
