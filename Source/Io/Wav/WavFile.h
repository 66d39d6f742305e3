// SPDX-License-Identifier: MIT
// Reads WAV files without trusting their headers.
#pragma once
#include "Io/Result.h"
#include "Io/Wav/SampledSound.h"
#include <cstdio>
#include <string_view>

namespace physvib {

/// The samples of a WAVE file (RIFF or RF64; PCM of 8, 16, 24 or 32 bits, float of 32), from the beginning of
/// `file`, which must be seekable; full scale is 1. Otherwise the error, without the file's name, also for
/// more than the limits of recordings or less than the header says. If the header has no length, the file's
/// size counts. Any thread.
Result<SampledSound> readWav(std::FILE& file);

/// The same block by block: returns empty, or the error of the file or of `taker`. Any thread.
std::string streamWav(std::FILE& file, SoundTaker& taker);

constexpr std::size_t wavSizeBytes = 28;

/// Length of a WAVE file (RIFF or RF64) according to its first wavSizeBytes bytes; 0 if they are not its
/// beginning. Any thread.
std::int64_t wavFileBytes(std::string_view head) noexcept;

} // namespace physvib
