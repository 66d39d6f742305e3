// SPDX-License-Identifier: GPL-3.0-or-later
// Waveform and spectrum of a contact for display, from a recording or from a material's mode.
#pragma once
#include "Measure/MaterialExtractor.h"
#include "Mixer/Window/FrequencyAxis.h"
#include <filesystem>
#include <string>
#include <vector>

namespace physvib {

/// An impact from its onset.
struct HitCourse {
    double rateHz = 0.0;
    std::vector<float> samples; ///< normalised to a peak of 1
    SpectrumLevels levels{};    ///< normalised to a peak of 0 dB
    double seconds() const noexcept { return static_cast<double>(samples.size()) / rateHz; }
};

/// A contact recording and its fitted mode.
struct RecordedHit {
    std::string name; ///< file name
    ContactSound sound;
    HitCourse course;
    double amplitude = 0.0; ///< of the fitted mode at the onset, in units of the course
};

/// Measures the strongest impact of a file, on any thread but the render thread; or one line with the file's
/// name. Takes up to two seconds.
Result<RecordedHit> measureHit(const std::filesystem::path& path);

/// sin(2 pi f t) exp(-tau t) until a decay of 60 dB, at most one second.
HitCourse courseOf(double frequencyHz, double decayPerSecond);

} // namespace physvib
