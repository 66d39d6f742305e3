// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib coupling`: measures the coupling matrix from recordings that drive one actuator at a
// time. Each gives a column; repetitions are averaged.
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

/// Command-line options.
struct CouplingOptions {
    std::string folder, layout, outPath;
};

/// Sums over repetitions, and their number per driven actuator.
struct Measured {
    explicit Measured(std::size_t enchanters)
        : sums(enchanters)
        , counts(enchanters, 0) {
        for (std::size_t j = 0; j < enchanters; ++j) sums.at(j, j) = 0.0;
    }
    CouplingMatrix sums;
    std::vector<int> counts;
};

using ByFrequency = std::map<double, Measured>;

/// Adds a recording: response of every actuator, in shares of its full scale, to a drive of 1 of actuator j.
std::string add(Measured& measured, std::size_t j, const std::vector<std::complex<double>>& tones,
                const LayoutDescription& layout) {
    const auto share = [&](std::size_t i) { return tones[i] / layout.enchanters[i].fullScaleG; };
    if (!(std::abs(share(j)) > 0.0))
        return "expected that the driven actuator vibrates, found silence on its channel";
    for (std::size_t i = 0; i < tones.size(); ++i) measured.sums.at(i, j) += share(i) / share(j);
    ++measured.counts[j];
    return {};
}

Result<MeasuredCoupling> meansOf(ByFrequency& all, const LayoutDescription& layout) {
    MeasuredCoupling coupling;
    for (auto& [hz, measured] : all) {
        for (std::size_t j = 0; j < measured.counts.size(); ++j) {
            if (measured.counts[j] == 0)
                return Failure{"expected a recording with actuator " + layout.enchanters[j].label +
                               " driven at " + numberText(hz) + " Hz, found none"};
            for (std::size_t i = 0; i < measured.counts.size(); ++i)
                measured.sums.at(i, j) /= measured.counts[j];
        }
        coupling.frequenciesHz.push_back(hz);
        coupling.matrices.push_back(measured.sums);
    }
    return coupling;
}

Result<MeasuredCoupling> couplingIn(const std::string& folder, const LayoutDescription& layout) {
    const auto list = RecordingList::open(folder, {"frequency_hz", "driven"});
    if (!list) return Failure{list.error};
    const std::size_t enchanters = layout.enchanters.size();
    ByFrequency all;
    for (const CsvRow& row : list.value.rows()) {
        const auto hz = list.value.frequencyHz(row);
        if (!hz) return Failure{hz.error};
        const auto driven = std::ranges::find(layout.enchanters, list.value.cell(row, "driven"),
                                              &EnchanterDescription::label);
        if (driven == layout.enchanters.end())
            return Failure{list.value.table().fault(row, *list.value.table().column("driven"),
                                                    "the label of an actuator of the layout")};
        const std::string path = list.value.path(row);
        const auto tones = channelTones(path, hz.value);
        if (!tones) return Failure{tones.error};
        if (tones.value.size() != enchanters)
            return Failure{path + ": expected a channel per actuator of the layout, " +
                           std::to_string(enchanters) + ", found " + std::to_string(tones.value.size())};
        const auto at = all.try_emplace(hz.value, enchanters).first;
        if (auto fault = add(at->second, static_cast<std::size_t>(driven - layout.enchanters.begin()),
                             tones.value, layout);
            !fault.empty())
            return Failure{path + ": " + fault};
    }
    auto coupling = meansOf(all, layout);
    return coupling ? coupling
                    : Result<MeasuredCoupling>{Failure{list.value.table().name + ": " + coupling.error}};
}

void declareCoupling(OptionTable& command, CouplingOptions& o) {
    command
        .add("folder", o.folder,
             "recordings, a channel per actuator's accelerometer, and " +
                 std::string(RecordingList::fileName) + ": file,driven,frequency_hz")
        .as("FOLDER")
        .required();
    command.add("--layout", o.layout, "whose actuators they are: labels and full scales").required();
    command.add("--out", o.outPath, "the coupling, for render --coupling").written("FILE.json").required();
}

int runCoupling(const CouplingOptions& o) {
    const auto layout = layoutNamed(o.layout);
    if (!layout) return leave(exitFailed, layout.error);
    const auto coupling = couplingIn(o.folder, layout.value);
    if (!coupling) return leave(exitFailed, coupling.error);
    const std::string text = couplingJson(coupling.value, layout.value.name,
                                          "measured: recordings of one driven actuator at a time");
    // rejects implausible values, e.g. a neighbour with five times the amplitude
    if (const auto read = readCoupling(text, o.outPath); !read) return leave(exitFailed, read.error);
    if (const auto error = writeFile(o.outPath, text); !error.empty()) return leave(exitFailed, error);
    std::cout << o.outPath << "  " << coupling.value.enchanters() << " actuators at "
              << coupling.value.frequenciesHz.size()
              << (coupling.value.frequenciesHz.size() == 1 ? " frequency\n" : " frequencies\n");
    return exitDone;
}

} // namespace

Command couplingCommand() {
    return commandOf("coupling",
                     "what actuators make of each other's vibration, from recordings, for render --coupling",
                     declareCoupling, runCoupling);
}

} // namespace physvib
