// SPDX-License-Identifier: GPL-3.0-or-later
// What every channel has just played, as a spectrum of what is felt.
#pragma once
#include "Core/Limits.h"
#include "Mixer/Window/FrequencyAxis.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// M only.
class SpectrumTrace {
public:
    /// A quarter of a second: 8 Hz between what is told apart.
    static constexpr int window = 2048;
    static constexpr int keptRateHz = 8000; ///< at least; enough for 1 kHz, and an eighth of the arithmetic

    SpectrumTrace() { setRate(48000); }
    /// Forgets what was heard.
    void setRate(int sampleRateHz);
    /// Appends frames of the first `heard` channels.
    void add(const float* const* channels, int heard, int frames);
    /// Of the last window, by a Hann window: a sine of full scale is 0 dB, within 0.3 dB.
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
