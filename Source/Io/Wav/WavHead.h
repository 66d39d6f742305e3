// SPDX-License-Identifier: MIT
// The header before the samples of a WAV file.
#pragma once
#include <cstdint>
#include <string>

namespace physvib {

constexpr std::int64_t wavHeadBytes = 104; ///< without the comment

/// The chunk with the comment; empty without one. Any thread.
std::string wavInfo(const std::string& comment);

/// 32-bit float, one and two channels plain, three and more WAVE_FORMAT_EXTENSIBLE with an empty speaker
/// mask; 4 GB and more RF64. `info`: of wavInfo. Any thread.
std::string wavHead(int channels, int sampleRateHz, std::int64_t dataBytes, const std::string& info);

/// True if a WAVE file of that size does not need RF64. Any thread.
constexpr bool fitsWav(int channels, std::int64_t frames) noexcept {
    return frames <= std::int64_t{0xffff'ff00} / (4 * channels);
}

} // namespace physvib
