// SPDX-License-Identifier: GPL-3.0-or-later
// Decimates the channels by averaging consecutive frames.
#include "Mixer/Strips/SpectrumTrace.h"
#include <algorithm>

namespace physvib {

void SpectrumTrace::setRate(int sampleRateHz) {
    framesPerSample_ = std::max(1, sampleRateHz / keptRateHz);
    keptRateHz_ = static_cast<double>(std::max(1, sampleRateHz)) / framesPerSample_;
    lanes_.assign(limits::maxEnchanters, {std::vector<float>(window), 0.0f});
    newest_ = summed_ = 0;
}

void SpectrumTrace::add(const float* const* channels, int heard, int frames) {
    for (int done = 0; done < frames;) {
        const int part = std::min(frames - done, framesPerSample_ - summed_);
        const bool isFull = summed_ + part == framesPerSample_;
        for (std::size_t j = 0; j < static_cast<std::size_t>(heard); ++j) {
            Lane& lane = lanes_[j];
            for (int k = done; k < done + part; ++k) lane.sum += channels[j][k];
            if (isFull)
                lane.kept[static_cast<std::size_t>(newest_)] =
                    std::exchange(lane.sum, 0.0f) / static_cast<float>(framesPerSample_);
        }
        done += part;
        summed_ = isFull ? 0 : summed_ + part;
        if (isFull) newest_ = (newest_ + 1) % window;
    }
}

} // namespace physvib
