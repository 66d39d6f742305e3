// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib attenuation`: isolation of layers from levels of recordings, by axis and condition.
#include "CommandLine/Command.h"
#include "CommandLine/Measure/RecordingList.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Study/Coupling.h"
#include <algorithm>
#include <filesystem>
#include <string>

namespace physvib {
namespace {

/// Command-line options. Recordings have one channel per axis of the accelerometer.
struct AttenuationOptions {
    std::string isolatedPath, referencePath; ///< without a reference, isolatedPath is a folder
    std::string exportPath, picturePath;     ///< for a folder; empty: none
};

constexpr const char* referenceMaterial = "reference";

int compareRecordings(const AttenuationOptions& o) {
    const auto isolated = axisLevels(o.isolatedPath), reference = axisLevels(o.referencePath);
    if (!isolated) return reportExit(exitFailed, isolated.error);
    if (!reference) return reportExit(exitFailed, reference.error);
    const std::size_t axisCount = reference.value.size();
    if (isolated.value.size() != axisCount)
        return reportExit(exitFailed, o.isolatedPath + ": expected the channels of " + o.referencePath +
                                          ", " + std::to_string(axisCount) + ", found " +
                                          std::to_string(isolated.value.size()));
    for (std::size_t i = 0; i < axisCount; ++i)
        if (!(reference.value[i] > 0.0))
            return reportExit(exitFailed, o.referencePath + ": channel " + std::to_string(i + 1) +
                                              ": expected a vibration, found silence");
    const auto ratios = attenuationRatios(isolated.value, reference.value);
    std::cout << "axis,attenuation_ratio\n";
    for (std::size_t i = 0; i < axisCount; ++i) std::cout << i + 1 << ',' << numberText(ratios[i]) << '\n';
    std::cout << "all," << numberText(combinedAttenuation(ratios)) << '\n';
    return exitDone;
}

Result<std::vector<IsolationMeasurement>> readMeasurements(const RecordingList& list) {
    std::vector<IsolationMeasurement> measurements;
    for (const CsvRow& row : list.rows()) {
        IsolationMeasurement m;
        m.source = list.path(row);
        const auto hz = list.frequencyHz(row);
        if (!hz) return Failure{hz.error};
        m.condition = {list.cell(row, "material"),     list.cell(row, "softener_percent"),
                       list.cell(row, "thickness_mm"), list.cell(row, "voltage_v"),
                       list.cell(row, "axis"),         hz.value};
        m.isReference = m.condition.material == referenceMaterial;
        auto levels = axisLevels(m.source);
        if (!levels) return Failure{levels.error};
        m.levels = std::move(levels.value);
        measurements.push_back(std::move(m));
    }
    return measurements;
}

/// Columns of the conditions in a table; the softener has one only if a recording names a softener.
class ConditionColumns {
public:
    explicit ConditionColumns(const std::vector<IsolationResult>& results)
        : hasSoftener_{std::ranges::any_of(
              results, [](const auto& result) { return !result.condition.softener.empty(); })} {}
    std::string names() const {
        return std::string{"material,"} + (hasSoftener_ ? "softener_percent," : "") +
               "thickness_mm,frequency_hz,voltage_v,axis,";
    }
    std::string cells(const IsolationCondition& c) const {
        std::string line;
        const auto add = [&](const std::string& cell) {
            appendCell(line, cell);
            line += ',';
        };
        add(c.material);
        if (hasSoftener_) add(c.softener);
        for (const std::string& cell : {c.thickness, numberText(c.frequencyHz), c.voltage, c.axis}) add(cell);
        return line;
    }

private:
    bool hasSoftener_;
};

/// One row per repetition, as input of statistical tests.
std::string repetitionTable(const std::vector<IsolationResult>& results) {
    const ConditionColumns columns{results};
    std::string table = columns.names() + "repetition,gamma\n";
    for (const IsolationResult& result : results)
        for (std::size_t k = 0; k < result.gammas.size(); ++k)
            table += columns.cells(result.condition) + std::to_string(k + 1) + "," +
                     numberText(result.gammas[k]) + "\n";
    return table;
}

int summariseFolder(const AttenuationOptions& o) {
    const auto list = RecordingList::open(o.isolatedPath, {"frequency_hz", "axis", "material"});
    if (!list) return reportExit(exitFailed, list.error);
    if (const auto clash = list.value.clashError(std::vector{o.exportPath, o.picturePath}); !clash.empty())
        return reportExit(exitUsage, clash);
    const auto measurements = readMeasurements(list.value);
    if (!measurements) return reportExit(exitFailed, measurements.error);
    const IsolationStudy study = summariseIsolation(measurements.value);
    if (!study.error.empty()) return reportExit(exitFailed, study.error);
    const int code = writeStudyFiles(
        {StudyFile{o.exportPath, [&] { return repetitionTable(study.results); }},
         StudyFile{o.picturePath, [&] { return chartSheet(isolationCharts(study.results)); }}});
    if (code != exitDone) return code;
    const ConditionColumns columns{study.results};
    std::cout << columns.names() << "repetitions,gamma,standard_deviation\n";
    for (const IsolationResult& result : study.results)
        std::cout << columns.cells(result.condition) << result.gammas.size() << ',' << numberText(result.mean)
                  << ',' << numberText(result.deviation) << '\n';
    return exitDone;
}

void declareAttenuation(OptionTable& command, AttenuationOptions& o) {
    command
        .add("isolated", o.isolatedPath,
             "recorded behind the layer, a channel per axis; or a folder of conditions with " +
                 std::string(RecordingList::fileName))
        .as("ISOLATED.wav|FOLDER")
        .required();
    command.add("reference", o.referencePath, "the same drive recorded without it").as("REFERENCE.wav");
    command.add("--export", o.exportPath, "of a folder: a row per repetition").outputFile("FILE.csv");
    command
        .add("--picture", o.picturePath,
             "of a folder: gamma over frequency: a curve per layer, of one per voltage")
        .outputFileNamed("FILE.svg");
}

int runAttenuation(const AttenuationOptions& o) {
    if (!o.referencePath.empty() && (!o.exportPath.empty() || !o.picturePath.empty()))
        return reportExit(exitUsage,
                          "attenuation: expected --export and --picture with a folder of conditions only");
    if (!o.referencePath.empty()) return compareRecordings(o);
    if (!std::filesystem::is_directory(o.isolatedPath))
        return reportExit(exitUsage, "attenuation: expected a reference beside " + inQuotes(o.isolatedPath) +
                                         ", or a folder of conditions");
    return summariseFolder(o);
}

} // namespace

Command attenuationCommand() {
    return makeCommand(
        "attenuation",
        "what an isolation layer holds back, from two recordings or a folder of conditions (thesis 3.1.1)",
        declareAttenuation, runAttenuation);
}

} // namespace physvib
