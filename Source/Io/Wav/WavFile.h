// SPDX-License-Identifier: MIT
// WAV files in, without trust in their headers.
#pragma once
#include "Io/Wav/SampledSound.h"
#include <cstdio>
#include <string_view>

namespace physvib {

/// The samples of a WAVE file (RIFF or RF64; PCM of 8, 16, 24 or 32 bits, float of 32), block by block, from
/// the beginning of `file`, which can be searched; full scale is 1. Empty, or what is wrong with it, without
/// its name: more than the limits of recordings, less than the header says, or what `taker` says. A length
/// that was not known when the header was written is what is there. Any thread.
std::string streamWav(std::FILE& file, SoundTaker& taker);

constexpr std::size_t wavSizeBytes = 28;

/// How long a WAVE file (RIFF or RF64) says it is in its first wavSizeBytes bytes; 0: they begin none. Any
/// thread.
std::int64_t wavFileBytes(std::string_view head) noexcept;

} // namespace physvib
