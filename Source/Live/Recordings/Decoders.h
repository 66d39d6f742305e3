// SPDX-License-Identifier: MIT
// Decoders of compressed recordings, by the libraries of their formats.
#pragma once
#include "Io/Wav/SampledSound.h"
#include <cstdio>
#include <string>

namespace physvib {

/// What a file with fewer samples than its header says is refused with.
std::string endsEarly(std::int64_t frames);

inline constexpr const char* notASound = "expected a WAV, FLAC or Ogg Vorbis file";

/// Decode a file from its start, block by block. Return empty, or one line with the file's error or that of
/// `taker`. Any thread but R.
std::string decodeFlac(std::FILE& file, SoundTaker& taker);
std::string decodeVorbis(std::FILE& file, std::size_t fileBytes, SoundTaker& taker);

} // namespace physvib
