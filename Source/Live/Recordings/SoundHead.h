// SPDX-License-Identifier: MIT
// What a sound file says of itself, checked against what is there, before a library reads it.
#pragma once
#include "Io/Result.h"
#include "Io/Wav/SampledSound.h"
#include <cstdint>
#include <cstdio>
#include <string>

namespace physvib {

/// The part of a file that libsndfile is to read, and how.
struct SoundHead {
    int format = 0;           ///< of libsndfile, where the part is bare samples; 0: a file of its own
    std::string head;         ///< what stands before the part, instead of what the file has there
    std::int64_t begin = 0;   ///< of the part, in bytes
    std::int64_t bytes = 0;   ///< its length
    SoundShape shape{};       ///< as the file says; 0 frames: libsndfile knows
    bool isSurveyed = false;  ///< all samples are looked at first: for their number, or their place
    int bits = 0, room = 0;   ///< of a sample of WAVE, and of its place
    bool isLowRather = false; ///< it stands in the lower bits, if the samples do not show where
};

/// Of a file that is `bytes` long. Or what is wrong with it, without its name: another kind of file, fewer
/// bytes or more than it says, several streams. A length that was not known when the header was written is
/// what is there. Any thread but R.
Result<SoundHead> readSoundHead(std::FILE& file, std::int64_t bytes);

} // namespace physvib
