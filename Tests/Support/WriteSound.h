// SPDX-License-Identifier: MIT
// Sound files as libsndfile writes them.
#pragma once
#include "Io/Wav/SampledSound.h"
#include <cmath>
#include <filesystem>
#include <sndfile.h>
#include <vector>

namespace physvib::test {

/// `format`: of libsndfile, such as SF_FORMAT_FLAC | SF_FORMAT_PCM_16. False if it cannot be written.
inline bool writeSound(const std::filesystem::path& path, int format, const SampledSound& sound) {
    const auto channels = sound.channels.size(), frames = sound.channels.front().size();
    SF_INFO info{0, sound.sampleRateHz, static_cast<int>(channels), format, 0, 0};
    SNDFILE* const file = sf_open(path.c_str(), SFM_WRITE, &info);
    if (file == nullptr) return false;
    const auto of = [&](std::size_t i) { return sound.channels[i % channels][i / channels]; };
    sf_count_t written = 0;
    if (const int type = format & SF_FORMAT_SUBMASK; type >= SF_FORMAT_PCM_S8 && type <= SF_FORMAT_PCM_U8) {
        std::vector<int> all(channels * frames); // the library's floats have another full scale
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(std::lround(of(i) * 0x1p31f));
        written = sf_writef_int(file, all.data(), static_cast<sf_count_t>(frames));
    } else {
        std::vector<float> all(channels * frames);
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = of(i);
        written = sf_writef_float(file, all.data(), static_cast<sf_count_t>(frames));
    }
    return sf_close(file) == 0 && written == static_cast<sf_count_t>(frames);
}

} // namespace physvib::test
