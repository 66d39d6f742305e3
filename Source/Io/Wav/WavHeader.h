// SPDX-License-Identifier: MIT
// Builds the header and the comment chunk before the samples of a WAV file, and its size limit.
#pragma once
#include <cstdint>
#include <string>

namespace physvib {

constexpr std::int64_t wavHeaderBytes = 104; ///< without the comment

/// The chunk with the comment, as bytes; empty without a comment. Any thread.
std::string wavInfoChunk(const std::string& comment);

/// The bytes before the samples of a 32-bit float file: one and two channels plain, three and more
/// WAVE_FORMAT_EXTENSIBLE without speakers; 4 GB and more RF64. `infoChunk`: from wavInfoChunk(). Any thread.
std::string wavHeader(int channels, int sampleRateHz, std::int64_t dataBytes, const std::string& infoChunk);

/// True if a WAVE file of that size does not need RF64. Any thread.
constexpr bool fitsWav(int channels, std::int64_t frames) noexcept {
    return frames <= std::int64_t{0xffff'ff00} / (4 * channels);
}

} // namespace physvib
