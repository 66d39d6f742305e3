// SPDX-License-Identifier: MIT
// What stands before the samples of a WAVE file of 32-bit floats: channels are enchanters, not speakers.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace physvib {

/// The format chunk: plain for one and two channels; three and more are extensible with an empty speaker mask. Any thread.
std::string wavFormatChunk(int channels, int sampleRateHz);

/// Everything up to the first sample of a file with so many bytes of them, less than wavMostBytes. Any thread.
std::string wavHead(int channels, int sampleRateHz, std::uint32_t dataBytes);

/// How long a WAVE file (RIFF or RF64) says it is in its first wavSizeBytes bytes; 0: they begin none. Any thread.
std::int64_t wavFileBytes(std::string_view head) noexcept;

constexpr std::size_t wavSizeBytes = 28;

constexpr std::int64_t wavMostBytes = 0xffff'ff00; // what a plain WAVE file can count, with its head

} // namespace physvib
