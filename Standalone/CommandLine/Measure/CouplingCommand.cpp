// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib coupling`: measures the coupling matrix from recordings that drive one actuator at a
// time. Each recording gives a column of the matrix; repetitions are averaged.
#include "CommandLine/Command.h"
#include "CommandLine/Measure/RecordingList.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Coupling.h"
#include "Scene/LayoutFile.h"
#include <map>
#include <string>

namespace physvib {
namespace {

struct CouplingOptions {
    std::string folder, layout, outPath;
};

/// Sums over repetitions, and their number per driven actuator.
struct CouplingSums {
    explicit CouplingSums(std::size_t actuatorCount)
        : sums(actuatorCount)
        , counts(actuatorCount, 0) {
        for (std::size_t j = 0; j < actuatorCount; ++j) sums.at(j, j) = 0.0;
    }
    CouplingMatrix sums;
    std::vector<int> counts;
};

using SumsByFrequency = std::map<double, CouplingSums>;

/// Adds a recording: response of every actuator, in shares of its full scale, to a drive of 1 of actuator j.
std::string addRecording(CouplingSums& measured, std::size_t j,
                         const std::vector<std::complex<double>>& tones, const LayoutDescription& layout) {
    const auto share = [&](std::size_t i) { return tones[i] / layout.actuators[i].fullScaleG; };
    if (!(std::abs(share(j)) > 0.0))
        return "expected that the driven actuator vibrates, found silence on its channel";
    for (std::size_t i = 0; i < tones.size(); ++i) measured.sums.at(i, j) += share(i) / share(j);
    ++measured.counts[j];
    return {};
}

Result<MeasuredCoupling> averageSums(SumsByFrequency& sumsByHz, const LayoutDescription& layout) {
    MeasuredCoupling coupling;
    for (auto& [hz, measured] : sumsByHz) {
        for (std::size_t j = 0; j < measured.counts.size(); ++j) {
            if (measured.counts[j] == 0)
                return Failure{"expected a recording with actuator " + layout.actuators[j].label +
                               " driven at " + numberText(hz) + " Hz, found none"};
            for (std::size_t i = 0; i < measured.counts.size(); ++i)
                measured.sums.at(i, j) /= measured.counts[j];
        }
        coupling.frequenciesHz.push_back(hz);
        coupling.matrices.push_back(measured.sums);
    }
    return coupling;
}

Result<MeasuredCoupling> measureCoupling(const RecordingList& list, const LayoutDescription& layout) {
    const std::size_t actuatorCount = layout.actuators.size();
    SumsByFrequency sumsByHz;
    for (const CsvRow& row : list.rows()) {
        const auto hz = list.frequencyHz(row);
        if (!hz) return Failure{hz.error};
        const auto drive =
            std::ranges::find(layout.actuators, list.cell(row, "driven"), &ActuatorDescription::label);
        if (drive == layout.actuators.end())
            return Failure{list.table().cellError(row, *list.table().column("driven"),
                                                  "the label of an actuator of the layout")};
        const std::string path = list.path(row);
        const auto tones = channelTones(list, row, hz.value);
        if (!tones) return Failure{tones.error};
        if (tones.value.size() != actuatorCount)
            return Failure{path + ": expected a channel per actuator of the layout, " +
                           std::to_string(actuatorCount) + ", found " + std::to_string(tones.value.size())};
        const auto sum = sumsByHz.try_emplace(hz.value, actuatorCount).first;
        if (auto error = addRecording(sum->second, static_cast<std::size_t>(drive - layout.actuators.begin()),
                                      tones.value, layout);
            !error.empty())
            return Failure{path + ": " + error};
    }
    auto coupling = averageSums(sumsByHz, layout);
    return coupling ? coupling : Result<MeasuredCoupling>{Failure{list.table().name + ": " + coupling.error}};
}

void declareCoupling(OptionTable& command, CouplingOptions& o) {
    command
        .add("folder", o.folder,
             "recordings, a channel per actuator's accelerometer, and " +
                 std::string(RecordingList::fileName) + ": file,driven,frequency_hz")
        .as("FOLDER")
        .required();
    command.add("--layout", o.layout, "whose actuators they are: labels and full scales").required();
    command.add("--out", o.outPath, "the coupling, for render --coupling").outputFile("FILE.json").required();
}

int runCoupling(const CouplingOptions& o) {
    const auto layout = resolveLayout(o.layout);
    if (!layout) return reportExit(exitFailed, layout.error);
    const auto list = RecordingList::open(o.folder, {"frequency_hz", "driven"});
    if (!list) return reportExit(exitFailed, list.error);
    if (const auto clash = list.value.clashError({&o.outPath, 1}); !clash.empty())
        return reportExit(exitUsage, clash);
    const auto coupling = measureCoupling(list.value, layout.value);
    if (!coupling) return reportExit(exitFailed, coupling.error);
    const std::string text = couplingJson(coupling.value, layout.value.name,
                                          "measured: recordings of one driven actuator at a time");
    // rejects implausible values, e.g. a neighbour with five times the amplitude
    if (const auto read = readCoupling(text, o.outPath); !read) return reportExit(exitFailed, read.error);
    if (const auto error = writeFile(o.outPath, text); !error.empty()) return reportExit(exitFailed, error);
    std::cout << o.outPath << "  " << coupling.value.enchanters() << " actuators at "
              << coupling.value.frequenciesHz.size()
              << (coupling.value.frequenciesHz.size() == 1 ? " frequency\n" : " frequencies\n");
    return exitDone;
}

} // namespace

Command couplingCommand() {
    return makeCommand(
        "coupling", "what actuators make of each other's vibration, from recordings, for render --coupling",
        declareCoupling, runCoupling);
}

} // namespace physvib
