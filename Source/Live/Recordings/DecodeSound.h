// SPDX-License-Identifier: MIT
// Samples of sound files, by libsndfile.
#pragma once
#include "Io/Wav/SampledSound.h"
#include <cstdint>
#include <cstdio>
#include <string>

namespace physvib {

/// Decodes a file of `bytes` bytes that can be searched, block by block; full scale is 1. WAVE (RIFF, RIFX,
/// RF64, BW64; PCM, float, G.711), AIFF, FLAC, Ogg Vorbis and Opus. Read whole, or refused: returns empty, or
/// one line without the file's name: what is wrong with it, a sample that is not finite, or what `taker`
/// says. `mostSeconds` bounds what does not say how long it is. Any thread but R.
std::string decodeSound(std::FILE& file, std::int64_t bytes, std::int64_t mostSeconds, SoundTaker& taker);

} // namespace physvib
