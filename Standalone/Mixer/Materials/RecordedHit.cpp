// SPDX-License-Identifier: GPL-3.0-or-later
// Scales the measured excerpt for display.
#include "Mixer/Materials/RecordedHit.h"
#include "Live/Recordings/ReadRecording.h"
#include "Measure/LoudestChannel.h"
#include "Measure/PartialFit.h"
#include "Measure/Spectrum.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace physvib {

namespace {

constexpr double longestSeconds = 1.0;

HitCourse courseFrom(std::vector<float> samples, double rateHz) {
    HitCourse course{rateHz, std::move(samples)};
    float peak = 1e-9f;
    for (const float x : course.samples) peak = std::max(peak, std::abs(x));
    for (float& x : course.samples) x /= peak;
    const auto heights = magnitudes(std::vector<double>(course.samples.begin(), course.samples.end()));
    const double binHz = rateHz / (2.0 * static_cast<double>(heights.size() - 1));
    const auto first = static_cast<std::size_t>(FrequencyAxis::lowHz / binHz),
               last = std::min(heights.size(), static_cast<std::size_t>(FrequencyAxis::highHz / binHz) + 2);
    const double highest = first < last
                               ? *std::max_element(heights.begin() + static_cast<std::ptrdiff_t>(first),
                                                   heights.begin() + static_cast<std::ptrdiff_t>(last))
                               : 1.0;
    course.levels = spectrumLevels(heights, binHz, std::max(highest, 1e-12));
    return course;
}

} // namespace

Result<RecordedHit> measureHit(const std::filesystem::path& path) {
    const auto name = path.filename().string();
    const auto recording = readRecording(path);
    if (!recording)
        return Failure{recording.error.starts_with(path.string())
                           ? name + recording.error.substr(path.string().size())
                           : recording.error};
    const auto& samples = loudestOf(recording.value.channels);
    const double rate = recording.value.sampleRateHz;
    const auto sound = extractMaterial(samples, rate, {FrequencyAxis::lowHz, FrequencyAxis::highHz});
    if (!sound) return Failure{name + ": " + sound.error};
    const auto begin = static_cast<std::size_t>(std::llround(sound.value.beginSeconds * rate));
    const auto end = std::min(
        samples.size(), begin + static_cast<std::size_t>(std::llround(sound.value.lengthSeconds * rate)));
    RecordedHit hit{name, sound.value,
                    courseFrom({samples.begin() + static_cast<std::ptrdiff_t>(begin),
                                samples.begin() + static_cast<std::ptrdiff_t>(end)},
                               rate),
                    0.0};
    const std::vector<double> x(hit.course.samples.begin(), hit.course.samples.end());
    PartialFit fit{x, rate};
    fit.add({2.0 * std::numbers::pi * sound.value.frequencyHz, sound.value.decayPerSecond, 0.0, 0.0});
    fit.solveLinear();
    hit.amplitude = fit.partials().front().amplitude();
    return hit;
}

HitCourse courseOf(double frequencyHz, double decayPerSecond) {
    const double rate = std::max(8000.0, 8.0 * frequencyHz),
                 seconds =
                     std::clamp(std::log(1000.0) / std::max(decayPerSecond, 1e-3), 0.01, longestSeconds);
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double t = static_cast<double>(i) / rate;
        samples[i] = static_cast<float>(std::sin(2.0 * std::numbers::pi * frequencyHz * t) *
                                        std::exp(-decayPerSecond * t));
    }
    return courseFrom(std::move(samples), rate);
}

} // namespace physvib
