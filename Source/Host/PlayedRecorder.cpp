// SPDX-License-Identifier: GPL-3.0-or-later
// Ring in, file out.
#include "Host/PlayedRecorder.h"
#include <algorithm>

namespace physvib {

PlayedRecorder::PlayedRecorder(const std::string& path, int channels, int sampleRateHz, double seconds)
    : sampleRateHz_{sampleRateHz}
    , wav_{path, channels, sampleRateHz}
    , ring_(static_cast<std::size_t>(channels), std::vector<float>(static_cast<std::size_t>(seconds * sampleRateHz)))
    , fifo_{static_cast<int>(ring_[0].size())} {}

void PlayedRecorder::take(const float* const* channels, int frames) noexcept PHYSVIB_NONBLOCKING {
    const auto scope = fifo_.write(frames);
    for (std::size_t j = 0; j < ring_.size(); ++j) {
        std::copy_n(channels[j], scope.blockSize1, ring_[j].begin() + scope.startIndex1);
        std::copy_n(channels[j] + scope.blockSize1, scope.blockSize2, ring_[j].begin() + scope.startIndex2);
    }
    const auto missing = static_cast<std::uint64_t>(frames - scope.blockSize1 - scope.blockSize2);
    lost_.store(lost_.load(std::memory_order_relaxed) + missing, std::memory_order_relaxed);
}

void PlayedRecorder::drain() {
    const auto scope = fifo_.read(fifo_.getNumReady());
    std::vector<const float*> at(ring_.size());
    for (const auto& [start, size] : {std::pair{scope.startIndex1, scope.blockSize1}, {scope.startIndex2, scope.blockSize2}}) {
        for (std::size_t j = 0; j < ring_.size(); ++j) at[j] = ring_[j].data() + start;
        wav_.write(at.data(), size);
    }
}

std::string PlayedRecorder::finish() {
    drain();
    return wav_.finish();
}

} // namespace physvib
