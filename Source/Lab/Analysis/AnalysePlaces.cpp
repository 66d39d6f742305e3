// SPDX-License-Identifier: MIT
// Analyses of pointing as text and tables: errors (means over participants of means over targets), perceptual
// resolution, percent counts.
#include "Io/Text/CleanText.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

bool isOnALine(const std::vector<PlaceTrial>& trials) {
    return std::ranges::all_of(trials, [](const PlaceTrial& t) { return t.y == 0.0 && t.trueY == 0.0; });
}

/// Over participants: means of their means over targets.
void summarise(ExportTable& summary, const std::string& condition, const std::vector<PlaceTrial>& trials) {
    const auto people = participantErrors(trials);
    const bool hasY = !isOnALine(trials);
    struct Measure {
        const char* name;
        double ParticipantError::*value;
        bool ParticipantError::*has = nullptr;
        bool isOfY = false;
    };
    using P = ParticipantError;
    for (const auto& [name, value, has, isOfY] :
         {Measure{"distance from the target", &P::distance}, Measure{"constant error, x", &P::constantX},
          Measure{"constant error, y", &P::constantY, nullptr, true},
          Measure{"variable error", &P::variable, &P::hasVariable},
          Measure{"gain, x", &P::gainX, &P::hasGainX}, Measure{"gain, y", &P::gainY, &P::hasGainY, true}}) {
        std::vector<double> values;
        for (const P& one : people)
            if (has == nullptr || one.*has) values.push_back(one.*value);
        if (values.empty() || (isOfY && !hasY)) continue;
        const Moments own{values};
        const bool hasSpread = own.deviation > 0.0;
        summary.row(condition, name, trials.size(), own.n, own.mean,
                    ExportTable::onlyIf(hasSpread, own.deviation),
                    ExportTable::onlyIf(hasSpread, own.least()), ExportTable::onlyIf(hasSpread, own.most()));
    }
}

} // namespace

Result<StudyData<PlaceTrial>> readTargets(const AnalysisJob& job) {
    if (auto fault = unitFault(job.columns); !fault.empty()) return Failure{std::move(fault)};
    return readStudyFiles(job, readPlaces);
}

void analysePlaces(const StudyData<PlaceTrial>& data, const Findings& to) {
    ExportTable summary{"places", data.isSimulated,
                        "condition,measure,trials,participants,mean,standard_deviation,interval_"
                        "least,interval_most"};
    for (const auto& condition : data.conditions) {
        summarise(summary, condition.name, condition.trials);
        for (const TargetError& one : targetErrors(condition.trials)) {
            to.table.row(condition.name, one.participant, one.target, one.trials, one.trueX, one.trueY,
                         one.constantX, one.constantY, ExportTable::onlyIf(one.trials > 1, one.variable),
                         one.distance);
        }
    }
    to.report.summary = summary.text();
}

namespace {

constexpr std::size_t mostTiesTold = 20;

/// "1+2 | 3 | 4" of {2, 1, 1}.
std::string groupWords(const std::vector<std::size_t>& groups) {
    std::string words;
    std::size_t line = 1;
    for (const std::size_t size : groups) {
        if (line > 1) words += " | ";
        for (std::size_t i = 0; i < size; ++i) words.append(i ? "+" : "").append(std::to_string(line++));
    }
    return words;
}

std::string sizeWords(const GridMerge& merge) {
    return std::to_string(merge.columnGroups.size()) + " x " + std::to_string(merge.rowGroups.size());
}

constexpr const char* gridColumns =
    "condition,resolution,columns,rows,sum_percent,standard_deviation"; ///< a row for each tie

void tell(ExportTable& summary, const PercentCounts& counts, const PerceptualResolution& resolution) {
    if (resolution.ties.empty()) summary.row(counts.condition, "0 x 0", "", "", "", "");
    for (std::size_t i = 0; i < std::min(resolution.ties.size(), mostTiesTold); ++i) {
        const GridMerge& merge = resolution.ties[i];
        summary.row(counts.condition, sizeWords(merge), groupWords(merge.columnGroups),
                    groupWords(merge.rowGroups), counts.sum(), counts.standardDeviation());
    }
}

void exportMerged(ExportTable& table, const PercentCounts& counts, const PerceptualResolution& resolution) {
    if (resolution.ties.empty()) return;
    const PercentCounts grid = merged(counts, resolution.ties.front());
    for (std::size_t r = 0; r < grid.rows; ++r)
        for (std::size_t c = 0; c < grid.columns; ++c) table.row(grid.condition, r + 1, c + 1, grid.at(r, c));
}

void exportNormals(ExportTable& table, const ConditionResolution& made) {
    for (std::size_t i = 0; i < made.normals.normals.size(); ++i) {
        const PlaceNormal& n = made.normals.normals[i];
        if (n.responses == 0) continue;
        table.row(made.condition, i % made.normals.columns + 1, i / made.normals.columns + 1, n.responses,
                  n.meanX, n.meanY, n.varianceX, n.varianceY, n.covariance, made.counts.percent[i],
                  std::size_t{n.isBorrowed});
    }
}

void warnOfSum(const PercentCounts& counts, std::vector<std::string>& warnings) {
    const double printed = 0.005 * static_cast<double>(counts.percent.size()); // rounding to two decimals
    if (std::abs(counts.sum() - 100.0) > printed + 1e-9)
        warnings.push_back(cleanLine(counts.condition) + ": percent counts sum to " +
                           fixedNumber(counts.sum(), 2) + ", expected 100 within " + fixedNumber(printed, 2));
}

ChartFrame frameOf(const ConditionResolution& one, const std::vector<std::string>& charts, bool isSimulated) {
    return {chartName(charts.size()), one.condition, isSimulated};
}

void addCounts(std::vector<std::string>& charts, const ConditionResolution& one, bool isSimulated) {
    charts.push_back(countsChart(frameOf(one, charts, isSimulated), one.counts));
    if (!one.resolution.ties.empty()) charts.push_back(mergedChart(frameOf(one, charts, isSimulated), one));
}

} // namespace

void analyseResolution(const StudyData<LocationTrial>& data, const Findings& to) {
    auto& [job, report, out, table] = to;
    std::vector<ConditionResolution> made;
    std::vector<PercentCounts> counts;
    for (const auto& condition : data.conditions) {
        made.push_back(resolveCondition(condition.name.empty() ? "all trials" : condition.name,
                                        condition.trials, job.thresholdPercent));
        const auto& one = made.back();
        for (const auto& words : one.normals.warnings)
            report.warnings.push_back(cleanLine(one.condition) + ": " + words);
        if (!one.normals.fault.empty())
            return void(report.error =
                            job.files.front() + ": " + cleanLine(one.condition) + ": " + one.normals.fault);
        counts.push_back(one.counts);
        exportNormals(table, one);
    }
    ExportTable summary{"resolution", data.isSimulated, gridColumns};
    for (const ConditionResolution& one : made) tell(summary, one.counts, one.resolution);
    report.summary = summary.text();
    Provenance provenance{PHYSVIB_VERSION, {{"analysis", "resolution"}}};
    if (data.isSimulated) provenance.entries.emplace_back("observer", "simulated");
    report.counts = percentCountsCsv(counts, provenance);
    report.picture = [made, conditions = data.conditions, isSimulated = data.isSimulated] {
        std::vector<std::string> charts;
        for (std::size_t c = 0; c < made.size(); ++c) {
            const auto frame = [&] { return frameOf(made[c], charts, isSimulated); };
            charts.push_back(responsesChart(frame(), made[c], conditions[c].trials));
            charts.push_back(territoryChart(frame(), made[c]));
            addCounts(charts, made[c], isSimulated);
        }
        return chartSheet(charts);
    };
}

void analysePercentCounts(const StudyData<PercentCounts>& data, const Findings& to) {
    const double threshold = to.job.thresholdPercent;
    ExportTable summary{"percent-counts", data.isSimulated, gridColumns};
    std::vector<ConditionResolution> made;
    for (const auto& condition : data.conditions) {
        const PercentCounts& counts = condition.trials.front();
        warnOfSum(counts, to.report.warnings);
        made.push_back({counts.condition, {}, counts, perceptualResolution(counts, threshold)});
        tell(summary, counts, made.back().resolution);
        exportMerged(to.table, counts, made.back().resolution);
    }
    to.report.summary = summary.text();
    to.report.picture = [made, isSimulated = data.isSimulated] {
        std::vector<std::string> charts;
        for (const ConditionResolution& one : made) addCounts(charts, one, isSimulated);
        return chartSheet(charts);
    };
}

} // namespace physvib
