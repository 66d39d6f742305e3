// SPDX-License-Identifier: MIT
// A WAVE file that this project has written, as one sound: for tests of rooms that link no reader of sounds.
#pragma once
#include "Io/Result.h"
#include "Io/Wav/SampledSound.h"
#include <cstdio>
#include <cstring>
#include <string>

namespace physvib {

/// All samples; or the error that these are not the bytes of WavSink.
inline Result<SampledSound> readWav(std::FILE& file) {
    std::string bytes;
    char block[4096];
    while (const std::size_t count = std::fread(block, 1, sizeof block, &file)) bytes.append(block, count);
    const auto format = bytes.find("fmt "), data = bytes.find("data");
    std::uint16_t channels = 0;
    std::uint32_t rateHz = 0, dataBytes = 0;
    if (data != std::string::npos && data + 8 <= bytes.size())
        std::memcpy(&dataBytes, &bytes[data + 4], sizeof dataBytes);
    if (dataBytes == 0 || data + 8 + dataBytes != bytes.size())
        return Failure{"expected a whole file of WavSink"};
    std::memcpy(&channels, &bytes[format + 10], sizeof channels);
    std::memcpy(&rateHz, &bytes[format + 12], sizeof rateHz);
    SampledSound sound{static_cast<int>(rateHz), std::vector<std::vector<float>>(channels)};
    for (std::size_t at = data + 8, n = 0; at + sizeof(float) <= bytes.size(); at += sizeof(float), ++n)
        std::memcpy(&sound.channels[n % channels].emplace_back(), &bytes[at], sizeof(float));
    return sound;
}

} // namespace physvib
