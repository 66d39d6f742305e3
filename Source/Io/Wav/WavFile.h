// SPDX-License-Identifier: MIT
// Reads WAV files without trusting their headers.
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

/// Length of a WAVE file (RIFF or RF64) according to its first wavSizeBytes bytes; 0 if they are not its
/// beginning. Any thread.
std::int64_t wavFileBytes(std::string_view head) noexcept;

} // namespace physvib
