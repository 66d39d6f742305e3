// SPDX-License-Identifier: GPL-3.0-or-later
// What there is to see of a contact: its course and its spectrum, recorded or as a material is played.
#pragma once
#include "Measure/MaterialExtractor.h"
#include "Mixer/Window/FrequencyAxis.h"
#include <filesystem>
#include <string>
#include <vector>

namespace physvib {

/// A hit, from its onset on.
struct HitCourse {
    double rateHz = 0.0;
    std::vector<float> samples; ///< the highest is 1
    SpectrumLevels levels{};    ///< the highest is 0 dB
    double seconds() const noexcept { return static_cast<double>(samples.size()) / rateHz; }
};

/// A recording of a contact, and what was found in it.
struct RecordedHit {
    std::string name; ///< of the file
    ContactSound sound;
    HitCourse course;
    double amplitude = 0.0; ///< of what was found, at the onset of the course
};

/// Measures the strongest hit of a file, on any thread but R; or one line with the file's name. Takes up to a
/// second or two.
Result<RecordedHit> measureHit(const std::filesystem::path& path);

/// sin(2 pi f t) exp(-tau t) until it has fallen by 60 dB, at most a second.
HitCourse courseOf(double frequencyHz, double decayPerSecond);

} // namespace physvib
