// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the channels of a recording, and measures their level or tone.
#include "CommandLine/Measure/RecordingList.h"
#include "Live/Recordings/ReadRecording.h"
#include "Measure/HitExcerpt.h"
#include <cmath>
#include <numbers>

namespace physvib {
namespace {

/// Level without the mean, which contains gravity; 0 for a constant.
double computeLevel(const std::vector<float>& x) {
    const double first = x.front(), size = static_cast<double>(x.size());
    double mean = 0.0, power = 0.0;
    for (const float s : x) mean += (s - first) / size;
    for (const float s : x) power += (s - first - mean) * (s - first - mean) / size;
    return std::sqrt(power);
}

/// Hann window, which suppresses gravity and the effect of incomplete periods; 0 for a constant.
std::complex<double> computeTone(const std::vector<float>& x, double radiansPerSample) {
    std::complex<double> sum = 0.0;
    const double step = 2.0 * std::numbers::pi / static_cast<double>(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) {
        const auto index = static_cast<double>(n);
        sum += (1.0 - std::cos(step * index)) * (static_cast<double>(x[n]) - x.front()) *
               std::polar(1.0, -radiansPerSample * index);
    }
    return sum * (2.0 / static_cast<double>(x.size()));
}

template <class Value, class Measure>
Result<std::vector<Value>> measureChannels(const std::string& path, Measure measure) {
    constexpr double minSeconds = 0.1; // five periods of 50 Hz, the thesis' lowest frequency
    const auto recording = readRecording(path);
    if (!recording) return Failure{recording.error};
    std::vector<Value> values;
    const double rateHz = recording.value.sampleRateHz;
    for (const auto& channel : recording.value.channels) {
        std::string error = recordingError(channel, rateHz, minSeconds);
        if (error.empty()) error = clippingError(channel, rateHz);
        if (!error.empty())
            return Failure{path + ": channel " + std::to_string(values.size() + 1) + ": " + error};
        const Result<Value> value = measure(channel, rateHz);
        if (!value) return Failure{value.error};
        values.push_back(value.value);
    }
    return values;
}

} // namespace

Result<std::vector<double>> axisLevels(const std::string& path) {
    return measureChannels<double>(
        path, [](const std::vector<float>& channel, double) { return computeLevel(channel); });
}

Result<std::vector<std::complex<double>>> channelTones(const RecordingList& list, const CsvRow& row,
                                                       double frequencyHz) {
    using Tone = std::complex<double>;
    return measureChannels<Tone>(
        list.path(row), [&](const std::vector<float>& channel, double rateHz) -> Result<Tone> {
            if (!(frequencyHz < 0.5 * rateHz))
                return Failure{list.table().cellError(row, *list.table().column("frequency_hz"),
                                                      "less than " + plainNumber(0.5 * rateHz) +
                                                          ", half the sample rate of " +
                                                          list.cell(row, "file"))};
            return computeTone(channel, 2.0 * std::numbers::pi * frequencyHz / rateHz);
        });
}

} // namespace physvib
