// SPDX-License-Identifier: MIT
// Analyses of identification (confusion matrices, information transfer, icons) and of pointing (errors,
// perceptual resolution, percent counts), as text and tables.
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Study/Summaries.h"
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <cmath>

namespace physvib {

Result<StudyData<IdentificationTrial>> readLabels(const AnalysisJob& job) {
    auto data = readStudyFiles(job, readIdentification);
    if (!data || job.tolerance == 0) return data;
    for (auto& condition : data.value.groups) {
        for (const auto& trial : condition.trials)
            if (!parseGridCell(trial.stimulus))
                return Failure{job.files.front() + ": --tolerance: expected grid labels r,c, found " +
                               inQuotes(trial.stimulus)};
        condition.trials = tolerate(std::move(condition.trials), job.tolerance);
    }
    return data;
}

namespace {

std::string bitsText(double value) { return fixedNumber(value, 2) + " bit"; }

std::vector<std::string> matrixWarnings(const ConfusionMatrix& matrix, const InformationTransfer& transfer) {
    std::vector<std::string> words;
    const auto totals = matrix.stimulusTotals();
    const auto [minTotal, maxTotal] = std::ranges::minmax(totals);
    if (minTotal != maxTotal) {
        const auto at = static_cast<std::size_t>(std::ranges::find(totals, minTotal) - totals.begin());
        words.push_back("stimuli have unequal numbers of answers: " + cleanLine(matrix.label(at)) + " " +
                        std::to_string(minTotal) + ", others up to " + std::to_string(maxTotal));
    }
    if (matrix.responses() > matrix.stimuli())
        words.push_back(
            "responses that are no stimulus count as wrong: " + cleanLine(matrix.label(matrix.stimuli())) +
            (matrix.responses() > matrix.stimuli() + 1 ? " and others" : ""));
    if (matrix.stimuli() == 1) words.emplace_back("one stimulus");
    if (!transfer.canBeCorrected())
        words.push_back(fixedNumber(transfer.trialsPerCell, 2) + " trials per cell, fewer than " +
                        fixedNumber(trialsPerCellForCorrection, 0) + ": IT is not corrected");
    return words;
}

/// Percent correct by guessing, where answers within `tolerance` steps count.
double guessingPercent(const ConfusionMatrix& matrix, int tolerance) {
    std::vector<IdentificationTrial> guessed;
    for (std::size_t i = 0; i < matrix.stimuli(); ++i)
        for (std::size_t j = 0; j < matrix.stimuli(); ++j)
            guessed.push_back({matrix.label(i), matrix.label(j)});
    const ConfusionMatrix chance{tolerate(std::move(guessed), tolerance)};
    return 100.0 * proportion(chance.correct(), chance.trials()).share;
}

/// A row of the summary: all trials together, and over participants, whose interval is cut at 0 and 100 %.
void summarise(ExportTable& summary, const std::string& condition, const ConfusionMatrix& matrix,
               const InformationTransfer& transfer, const std::vector<ParticipantTransfer>& people,
               double chancePercent) {
    const Proportion all = proportion(matrix.correct(), matrix.trials());
    std::vector<double> shares, bits;
    for (const ParticipantTransfer& person : people) {
        shares.push_back(100.0 * static_cast<double>(person.matrix.correct()) /
                         static_cast<double>(person.matrix.trials()));
        if (person.matrix.stimuli() == matrix.stimuli()) bits.push_back(person.transfer.bits);
    }
    const Moments moments{shares}, bitMoments{bits};
    const bool hasSpread = moments.deviation > 0.0, isSingle = people.size() < 2;
    summary.row(
        condition, matrix.stimuli(), std::size_t{matrix.trials()}, chancePercent, 100.0 * all.share,
        people.size(), valueIf(!isSingle, moments.mean), valueIf(hasSpread, moments.deviation),
        valueIf(isSingle || hasSpread, isSingle ? 100.0 * all.lower : std::max(0.0, moments.lowerLimit())),
        valueIf(isSingle || hasSpread, isSingle ? 100.0 * all.upper : std::min(100.0, moments.upperLimit())),
        isSingle    ? "over trials, Wilson's"
        : hasSpread ? "t, cut at 0 and 100"
                    : "",
        transfer.bits, valueIf(transfer.canBeCorrected(), transfer.correctedBits()), transfer.maxBits,
        transfer.minBits, valueIf(bitMoments.n > 1, bitMoments.mean),
        valueIf(bitMoments.n > 1, bitMoments.deviation));
}

/// Writes each participant to both tables; returns the names of those who lack stimuli.
std::string exportParticipants(const std::string& condition, const std::vector<ParticipantTransfer>& people,
                               std::size_t stimuli, bool includesAll, ExportTable& countTable,
                               ExportTable& peopleTable) {
    std::string incomplete;
    for (const auto& [participant, matrix, transfer] : people) {
        for (std::size_t i = 0; i < matrix.stimuli(); ++i)
            for (std::size_t j = 0; j < matrix.responses(); ++j)
                countTable.row(condition, participant, matrix.label(i), matrix.label(j),
                               std::size_t{matrix.count(i, j)});
        const bool hasAllStimuli = matrix.stimuli() == stimuli;
        const double share = static_cast<double>(matrix.correct()) / static_cast<double>(matrix.trials());
        peopleTable.row(condition, participant, std::size_t{matrix.trials()},
                        valueIf(hasAllStimuli || includesAll, 100.0 * share), transfer.bits,
                        valueIf(transfer.canBeCorrected(), transfer.correctedBits()));
        if (!hasAllStimuli) incomplete += (incomplete.empty() ? "" : ", ") + cleanLine(participant);
    }
    return incomplete;
}

std::string stimuliText(const ConfusionMatrix& matrix) {
    int enchanters = 0;
    for (std::size_t i = 0; i < matrix.stimuli(); ++i) {
        const auto pattern = parsePatternLabel(matrix.label(i));
        if (!pattern) return std::to_string(matrix.stimuli()) + " stimuli";
        for (int k = 0; k < pattern->count; ++k)
            enchanters = std::max(enchanters, pattern->actuators[static_cast<std::size_t>(k)] + 1);
    }
    return std::to_string(matrix.stimuli()) + " patterns on " +
           plural(static_cast<std::size_t>(enchanters), "actuator");
}

std::string nameOr(const std::string& name, const char* fallback) { return name.empty() ? fallback : name; }

} // namespace

void analyseConfusion(const StudyData<IdentificationTrial>& data, const AnalysisOutput& output) {
    auto& [job, report, out, table] = output;
    ExportTable peopleTable{"confusion-participants", data.isSimulated,
                            "condition,participant,trials,percent_correct,it_bits,corrected_it_bits"};
    ExportTable summary{
        "confusion", data.isSimulated,
        "condition,stimuli,trials,chance_percent,percent_correct,participants,mean_percent,standard_"
        "deviation,least_percent,most_percent,interval,it_bits,corrected_it_bits,most_bits,fano_bits,mean_"
        "own_bits,deviation_own_bits"};
    std::vector<std::pair<std::string, ConfusionMatrix>> matrices;
    for (const auto& condition : data.groups) {
        const ConfusionMatrix matrix{condition.trials};
        const InformationTransfer transfer = informationTransfer(matrix);
        const std::string prefix = condition.name.empty() ? "" : cleanLine(condition.name) + ": ";
        for (const auto& words : matrixWarnings(matrix, transfer)) report.warnings.push_back(prefix + words);
        const auto people = transferByParticipant(condition.trials),
                   compared = keepComplete(people, matrix.stimuli());
        summarise(summary, condition.name, matrix, transfer, compared,
                  guessingPercent(matrix, job.tolerance));
        const bool includesAll = compared.size() == people.size();
        const std::string incomplete =
            exportParticipants(condition.name, people, matrix.stimuli(), includesAll, table, peopleTable);
        if (!incomplete.empty())
            report.warnings.push_back(prefix + "stimuli are lacking of " + incomplete +
                                      (includesAll ? "" : ", left out of means of participants"));
        matrices.emplace_back(nameOr(condition.name, "all trials"), matrix);
    }
    report.participants = peopleTable.text();
    report.summary = summary.text();
    report.picture = [matrices, isSimulated = data.isSimulated] {
        std::vector<std::string> charts;
        for (const auto& [name, matrix] : matrices)
            charts.push_back(confusionChart({chartName(charts.size()), name, isSimulated}, matrix));
        return chartSheet(charts);
    };
}

void analyseIcons(const StudyData<IdentificationTrial>& data, const AnalysisOutput& output) {
    auto& [job, report, out, table] = output;
    out << job.meanings << " meanings need " << bitsText(bitsForMeanings(job.meanings)) << '\n';
    std::vector<std::pair<std::string, ConfusionMatrix>> matrices;
    for (const auto& condition : data.groups)
        matrices.emplace_back(condition.name, ConfusionMatrix{condition.trials});
    std::ranges::stable_sort(matrices, {}, [](const auto& m) { return m.second.stimuli(); });
    BarChart icons{{chartName(0), "Tactile icons: ", data.isSimulated}, "stimulus", "correct (%)"};
    icons.max = 100.0;
    for (const auto& [name, matrix] : matrices) {
        const InformationTransfer transfer = informationTransfer(matrix);
        const bool transfersEnough = transfer.bestBits() >= bitsForMeanings(job.meanings);
        out << cleanLine(nameOr(name, "all trials")) << ": " << stimuliText(matrix) << ", "
            << bitsText(transfer.bestBits()) << ": " << (transfersEnough ? "enough" : "too little") << '\n';
        if (!transfersEnough || !icons.groups.empty()) continue;
        icons.frame.title += nameOr(name, "all trials");
        for (const std::size_t i : leastConfused(matrix, job.meanings)) {
            const double share = shareCorrect(matrix, i);
            out << "  " << cleanLine(matrix.label(i)) << "  " << percentNumber(share) << " % correct\n";
            table.row(name, matrix.label(i), 100.0 * share);
            icons.add(matrix.label(i), ChartValue::withMargin(100.0 * share));
        }
    }
    if (icons.groups.empty())
        report.error = job.files.front() + ": expected a condition that transfers " +
                       bitsText(bitsForMeanings(job.meanings)) + ", found none";
    report.picture = [icons] { return barChart(icons); };
}

// Pointing. Errors are means over participants of means over targets.

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
        bool ParticipantError::*hasValue = nullptr;
        bool isOfY = false;
    };
    using P = ParticipantError;
    for (const auto& [name, value, hasValue, isOfY] :
         {Measure{"distance from the target", &P::distance}, Measure{"constant error, x", &P::constantX},
          Measure{"constant error, y", &P::constantY, nullptr, true},
          Measure{"variable error", &P::variable, &P::hasVariable},
          Measure{"gain, x", &P::gainX, &P::hasGainX}, Measure{"gain, y", &P::gainY, &P::hasGainY, true}}) {
        std::vector<double> values;
        for (const P& person : people)
            if (hasValue == nullptr || person.*hasValue) values.push_back(person.*value);
        if (values.empty() || (isOfY && !hasY)) continue;
        const Moments moments{values};
        const bool hasSpread = moments.deviation > 0.0;
        summary.row(condition, name, trials.size(), moments.n, moments.mean,
                    valueIf(hasSpread, moments.deviation), valueIf(hasSpread, moments.lowerLimit()),
                    valueIf(hasSpread, moments.upperLimit()));
    }
}

} // namespace

Result<StudyData<PlaceTrial>> readTargets(const AnalysisJob& job) {
    if (auto error = unitError(job.columns); !error.empty()) return Failure{std::move(error)};
    return readStudyFiles(job, readPlaces);
}

void analysePlaces(const StudyData<PlaceTrial>& data, const AnalysisOutput& output) {
    ExportTable summary{"places", data.isSimulated,
                        "condition,measure,trials,participants,mean,standard_deviation,interval_"
                        "least,interval_most"};
    for (const auto& condition : data.groups) {
        summarise(summary, condition.name, condition.trials);
        for (const TargetError& error : targetErrors(condition.trials)) {
            output.table.row(condition.name, error.participant, error.target, error.trials, error.trueX,
                             error.trueY, error.constantX, error.constantY,
                             valueIf(error.trials > 1, error.variable), error.distance);
        }
    }
    output.report.summary = summary.text();
}

namespace {

constexpr std::size_t maxTiesShown = 20;

/// "1+2 | 3 | 4" of {2, 1, 1}.
std::string groupText(const std::vector<std::size_t>& groups) {
    std::string words;
    std::size_t line = 1;
    for (const std::size_t size : groups) {
        if (line > 1) words += " | ";
        for (std::size_t i = 0; i < size; ++i) words.append(i ? "+" : "").append(std::to_string(line++));
    }
    return words;
}

std::string sizeText(const GridMerge& merge) {
    return std::to_string(merge.columnGroups.size()) + " x " + std::to_string(merge.rowGroups.size());
}

constexpr const char* gridColumns =
    "condition,resolution,columns,rows,sum_percent,standard_deviation"; ///< a row for each tie

void addResolution(ExportTable& summary, const PercentCounts& counts,
                   const PerceptualResolution& resolution) {
    if (resolution.ties.empty()) summary.row(counts.condition, "0 x 0", "", "", "", "");
    for (std::size_t i = 0; i < std::min(resolution.ties.size(), maxTiesShown); ++i) {
        const GridMerge& merge = resolution.ties[i];
        summary.row(counts.condition, sizeText(merge), groupText(merge.columnGroups),
                    groupText(merge.rowGroups), counts.sum(), counts.standardDeviation());
    }
}

void exportMerged(ExportTable& table, const PercentCounts& counts, const PerceptualResolution& resolution) {
    if (resolution.ties.empty()) return;
    const PercentCounts grid = mergedCounts(counts, resolution.ties.front());
    for (std::size_t r = 0; r < grid.rows; ++r)
        for (std::size_t c = 0; c < grid.columns; ++c) table.row(grid.condition, r + 1, c + 1, grid.at(r, c));
}

void exportNormals(ExportTable& table, const ConditionResolution& result) {
    for (std::size_t i = 0; i < result.normals.normals.size(); ++i) {
        const PlaceNormal& n = result.normals.normals[i];
        if (n.responses == 0) continue;
        table.row(result.condition, i % result.normals.columns + 1, i / result.normals.columns + 1,
                  n.responses, n.meanX, n.meanY, n.varianceX, n.varianceY, n.covariance,
                  result.counts.percent[i], std::size_t{n.usesPooledCovariance});
    }
}

void checkPercentSum(const PercentCounts& counts, std::vector<std::string>& warnings) {
    const double tolerance = 0.005 * static_cast<double>(counts.percent.size()); // rounding to two decimals
    if (std::abs(counts.sum() - 100.0) > tolerance + 1e-9)
        warnings.push_back(cleanLine(counts.condition) + ": percent counts sum to " +
                           fixedNumber(counts.sum(), 2) + ", expected 100 within " +
                           fixedNumber(tolerance, 2));
}

ChartFrame makeFrame(const ConditionResolution& result, const std::vector<std::string>& charts,
                     bool isSimulated) {
    return {chartName(charts.size()), result.condition, isSimulated};
}

void addCounts(std::vector<std::string>& charts, const ConditionResolution& result, bool isSimulated) {
    charts.push_back(countsChart(makeFrame(result, charts, isSimulated), result.counts));
    if (!result.resolution.ties.empty())
        charts.push_back(mergedChart(makeFrame(result, charts, isSimulated), result));
}

} // namespace

void analyseResolution(const StudyData<LocationTrial>& data, const AnalysisOutput& output) {
    auto& [job, report, out, table] = output;
    std::vector<ConditionResolution> results;
    std::vector<PercentCounts> counts;
    for (const auto& condition : data.groups) {
        results.push_back(resolveCondition(condition.name.empty() ? "all trials" : condition.name,
                                           condition.trials, job.thresholdPercent));
        const auto& result = results.back();
        for (const auto& words : result.normals.warnings)
            report.warnings.push_back(cleanLine(result.condition) + ": " + words);
        if (!result.normals.error.empty())
            return void(report.error = job.files.front() + ": " + cleanLine(result.condition) + ": " +
                                       result.normals.error);
        counts.push_back(result.counts);
        exportNormals(table, result);
    }
    ExportTable summary{"resolution", data.isSimulated, gridColumns};
    for (const ConditionResolution& result : results)
        addResolution(summary, result.counts, result.resolution);
    report.summary = summary.text();
    Provenance provenance{PHYSVIB_VERSION, {{"analysis", "resolution"}}};
    if (data.isSimulated) provenance.entries.emplace_back("observer", "simulated");
    report.counts = percentCountsCsv(counts, provenance);
    report.picture = [results, conditions = data.groups, isSimulated = data.isSimulated] {
        std::vector<std::string> charts;
        for (std::size_t c = 0; c < results.size(); ++c) {
            const auto frame = [&] { return makeFrame(results[c], charts, isSimulated); };
            charts.push_back(responsesChart(frame(), results[c], conditions[c].trials));
            charts.push_back(territoryChart(frame(), results[c]));
            addCounts(charts, results[c], isSimulated);
        }
        return chartSheet(charts);
    };
}

void analysePercentCounts(const StudyData<PercentCounts>& data, const AnalysisOutput& output) {
    const double threshold = output.job.thresholdPercent;
    ExportTable summary{"percent-counts", data.isSimulated, gridColumns};
    std::vector<ConditionResolution> results;
    for (const auto& condition : data.groups) {
        const PercentCounts& counts = condition.trials.front();
        checkPercentSum(counts, output.report.warnings);
        results.push_back({counts.condition, {}, counts, perceptualResolution(counts, threshold)});
        addResolution(summary, counts, results.back().resolution);
        exportMerged(output.table, counts, results.back().resolution);
    }
    output.report.summary = summary.text();
    output.report.picture = [results, isSimulated = data.isSimulated] {
        std::vector<std::string> charts;
        for (const ConditionResolution& result : results) addCounts(charts, result, isSimulated);
        return chartSheet(charts);
    };
}

} // namespace physvib
