// SPDX-License-Identifier: GPL-3.0-or-later
// A recording of a hit as Eq. 5.1 has it, with what a room and a microphone add.
#pragma once
#include "Io/Wav/WavSink.h"
#include "Stimuli/SeededRandom.h"
#include <array>
#include <cmath>
#include <juce_core/juce_core.h>
#include <numbers>
#include <vector>

namespace physvib {

/// Writes a knock on wood: 352 Hz, 98 /s, two higher partials, and a little noise; the same samples each
/// time. True if it was written.
inline bool writeKnock(const juce::File& file) {
    constexpr int rate = 48000, frames = rate / 2, onset = rate / 20;
    // Hz, 1/s, amplitude
    constexpr std::array<std::array<double, 3>, 3> partials{
        {{352.0, 98.0, 0.5}, {612.0, 210.0, 0.2}, {840.0, 260.0, 0.12}}};
    SeededRandom random{1};
    std::vector<float> samples(frames);
    for (int i = 0; i < frames; ++i) {
        double x = 0.004 * random.normal();
        for (const auto& [hz, decay, amplitude] : partials)
            if (const double t = static_cast<double>(i - onset) / rate; t >= 0.0)
                x += amplitude * std::sin(2.0 * std::numbers::pi * hz * t) * std::exp(-decay * t);
        samples[static_cast<std::size_t>(i)] = static_cast<float>(x);
    }
    WavSink sink{file.getFullPathName().toStdString(), 1, rate};
    const float* channels[]{samples.data()};
    return sink.write(channels, frames) && sink.finish().empty();
}

} // namespace physvib
