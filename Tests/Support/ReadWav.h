// SPDX-License-Identifier: MIT
// A WAVE file as one sound.
#pragma once
#include "Io/Result.h"
#include "Io/Wav/WavFile.h"

namespace physvib {

/// All samples of a file, or what is wrong with it.
inline Result<SampledSound> readWav(std::FILE& file) {
    SoundKeeper keeper;
    if (auto fault = streamWav(file, keeper); !fault.empty()) return Failure{fault};
    return std::move(keeper.sound);
}

} // namespace physvib
