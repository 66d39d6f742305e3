// SPDX-License-Identifier: GPL-3.0-or-later
// Short-time spectrum of recent samples of every channel, in the range of vibration perception.
#pragma once
#include "Core/Limits.h"
#include "Mixer/Window/FrequencyAxis.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// Message thread only.
class SpectrumTrace {
public:
    /// A quarter of a second, which gives a resolution of 8 Hz.
    static constexpr int window = 2048;
    static constexpr int keptRateHz = 8000; ///< minimum rate after decimation; sufficient for 1 kHz at an
                                            ///< eighth of the cost

    SpectrumTrace() { setRate(48000); }
    /// Clears the buffers.
    void setRate(int sampleRateHz);
    /// Appends frames of the first `heard` channels.
    void add(const float* const* channels, int heard, int frames);
    /// Spectrum of the last window with a Hann window: a full-scale sine is 0 dB, within 0.3 dB.
    SpectrumLevels levels(int channel) const;

private:
    struct Lane {
        std::vector<float> kept;
        float sum = 0.0f;
    };
    std::vector<Lane> lanes_;
    double keptRateHz_ = keptRateHz;
    int framesPerSample_ = 1, newest_ = 0, summed_ = 0;
};

} // namespace physvib
