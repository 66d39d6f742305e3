// SPDX-License-Identifier: GPL-3.0-or-later
// Levels of two recordings, axis by axis.
#include "CommandLine/Measure/AttenuationCommand.h"
#include "CommandLine/ExitCode.h"
#include "Files/Text/NumberText.h"
#include "Host/Recordings/ReadRecording.h"
#include "Measure/RecordingFaults.h"
#include "Study/Coupling.h"
#include <CLI/CLI.hpp>
#include <cmath>

namespace physvib {
namespace {

/// Root mean square without what stands still, as gravity does.
double levelOf(const std::vector<float>& x) {
    double mean = 0.0, power = 0.0;
    for (const float s : x) mean += s / static_cast<double>(x.size());
    for (const float s : x) power += (s - mean) * (s - mean) / static_cast<double>(x.size());
    return std::sqrt(power);
}

Result<std::vector<double>> levelsOf(const std::string& path) {
    constexpr double shortestSeconds = 0.1; // five periods of 50 Hz, the thesis' lowest
    const auto recording = readRecording(path);
    if (!recording) return Failure{recording.error};
    std::vector<double> levels;
    for (const auto& axis : recording.value.channels) {
        const double rateHz = recording.value.sampleRateHz;
        std::string fault = recordingFault(axis, rateHz, shortestSeconds);
        if (fault.empty()) fault = clippingFault(axis, rateHz);
        if (!fault.empty()) return Failure{path + ": channel " + std::to_string(levels.size() + 1) + ": " + fault};
        levels.push_back(levelOf(axis));
    }
    return levels;
}

} // namespace

void declareAttenuation(CLI::App& command, AttenuationOptions& o) {
    command.add_option("isolated", o.isolatedPath, "recorded behind the layer, a channel per axis")->type_name("ISOLATED.wav")->required();
    command.add_option("reference", o.referencePath, "the same drive recorded without it")->type_name("REFERENCE.wav")->required();
}

int runAttenuation(const AttenuationOptions& o) {
    const auto isolated = levelsOf(o.isolatedPath), reference = levelsOf(o.referencePath);
    if (!isolated) return leave(exitFailed, isolated.error);
    if (!reference) return leave(exitFailed, reference.error);
    const std::size_t axes = reference.value.size();
    if (isolated.value.size() != axes)
        return leave(exitFailed, o.isolatedPath + ": expected the channels of " + o.referencePath + ", " + std::to_string(axes) + ", found " + std::to_string(isolated.value.size()));
    for (std::size_t i = 0; i < axes; ++i)
        if (!(reference.value[i] > 0.0)) return leave(exitFailed, o.referencePath + ": channel " + std::to_string(i + 1) + ": expected a vibration, found silence");
    const auto ratios = attenuationRatios(isolated.value, reference.value);
    std::cout << "axis,attenuation_ratio\n";
    for (std::size_t i = 0; i < axes; ++i) std::cout << i + 1 << ',' << numberText(ratios[i]) << '\n';
    std::cout << "all," << numberText(combinedAttenuation(ratios)) << '\n';
    return exitDone;
}

} // namespace physvib
