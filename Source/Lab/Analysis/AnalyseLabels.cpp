// SPDX-License-Identifier: MIT
// Analyses of identification: confusion matrices, information transfer and icons, as text and tables.
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Study/Summaries.h"
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <cmath>

namespace physvib {

Result<StudyData<IdentificationTrial>> readLabels(const AnalysisJob& o) {
    auto data = readStudyFiles(o, readIdentification);
    if (!data || o.tolerance == 0) return data;
    for (auto& condition : data.value.conditions) {
        for (const auto& trial : condition.trials)
            if (!parseGridCell(trial.stimulus))
                return Failure{o.files.front() + ": --tolerance: expected grid labels r,c, found " +
                               inQuotes(trial.stimulus)};
        condition.trials = withTolerance(std::move(condition.trials), o.tolerance);
    }
    return data;
}

namespace {

std::string bits(double value) { return fixedNumber(value, 2) + " bit"; }

std::vector<std::string> matrixWarnings(const ConfusionMatrix& matrix, const InformationTransfer& it) {
    std::vector<std::string> words;
    const auto totals = matrix.stimulusTotals();
    const auto [fewest, most] = std::ranges::minmax(totals);
    if (fewest != most) {
        const auto at = static_cast<std::size_t>(std::ranges::find(totals, fewest) - totals.begin());
        words.push_back("stimuli have unequal numbers of answers: " + cleanLine(matrix.label(at)) + " " +
                        std::to_string(fewest) + ", others up to " + std::to_string(most));
    }
    if (matrix.responses() > matrix.stimuli())
        words.push_back(
            "responses that are no stimulus count as wrong: " + cleanLine(matrix.label(matrix.stimuli())) +
            (matrix.responses() > matrix.stimuli() + 1 ? " and others" : ""));
    if (matrix.stimuli() == 1) words.emplace_back("one stimulus");
    if (!it.canBeCorrected())
        words.push_back(fixedNumber(it.trialsPerCell, 2) + " trials per cell, fewer than " +
                        fixedNumber(trialsPerCellForCorrection, 0) + ": IT is not corrected");
    return words;
}

/// Percent correct by guessing, where answers within `tolerance` steps count.
double chanceOf(const ConfusionMatrix& matrix, int tolerance) {
    std::vector<IdentificationTrial> guessed;
    for (std::size_t i = 0; i < matrix.stimuli(); ++i)
        for (std::size_t j = 0; j < matrix.stimuli(); ++j)
            guessed.push_back({matrix.label(i), matrix.label(j)});
    const ConfusionMatrix chance{withTolerance(std::move(guessed), tolerance)};
    return 100.0 * proportion(chance.correct(), chance.trials()).share;
}

/// A row of the summary: all trials together, and over participants, whose interval is cut at 0 and 100 %.
void summarise(ExportTable& summary, const std::string& condition, const ConfusionMatrix& matrix,
               const InformationTransfer& it, const std::vector<ParticipantTransfer>& people,
               double chancePercent) {
    const Proportion all = proportion(matrix.correct(), matrix.trials());
    std::vector<double> shares, bits;
    for (const ParticipantTransfer& own : people) {
        shares.push_back(100.0 * static_cast<double>(own.matrix.correct()) /
                         static_cast<double>(own.matrix.trials()));
        if (own.matrix.stimuli() == matrix.stimuli()) bits.push_back(own.transfer.bits);
    }
    const Moments moments{shares}, transferred{bits};
    const bool hasSpread = moments.deviation > 0.0, isAlone = people.size() < 2;
    summary.row(condition, matrix.stimuli(), std::size_t{matrix.trials()}, chancePercent, 100.0 * all.share,
                people.size(), onlyIf(!isAlone, moments.mean), onlyIf(hasSpread, moments.deviation),
                onlyIf(isAlone || hasSpread, isAlone ? 100.0 * all.least : std::max(0.0, moments.least())),
                onlyIf(isAlone || hasSpread, isAlone ? 100.0 * all.most : std::min(100.0, moments.most())),
                isAlone     ? "over trials, Wilson's"
                : hasSpread ? "t, cut at 0 and 100"
                            : "",
                it.bits, onlyIf(it.canBeCorrected(), it.correctedBits()), it.mostBits, it.leastBits,
                onlyIf(transferred.n > 1, transferred.mean),
                onlyIf(transferred.n > 1, transferred.deviation));
}

/// Writes each participant to both tables; returns the names of those who lack stimuli.
std::string exportPeople(const std::string& condition, const std::vector<ParticipantTransfer>& people,
                         std::size_t stimuli, bool isOfAll, ExportTable& counts, ExportTable& each) {
    std::string lacking;
    for (const auto& [participant, matrix, transfer] : people) {
        for (std::size_t i = 0; i < matrix.stimuli(); ++i)
            for (std::size_t j = 0; j < matrix.responses(); ++j)
                counts.row(condition, participant, matrix.label(i), matrix.label(j),
                           std::size_t{matrix.count(i, j)});
        const bool isWhole = matrix.stimuli() == stimuli;
        const double share = static_cast<double>(matrix.correct()) / static_cast<double>(matrix.trials());
        each.row(condition, participant, std::size_t{matrix.trials()},
                 onlyIf(isWhole || isOfAll, 100.0 * share), transfer.bits,
                 onlyIf(transfer.canBeCorrected(), transfer.correctedBits()));
        if (!isWhole) lacking += (lacking.empty() ? "" : ", ") + cleanLine(participant);
    }
    return lacking;
}

std::string patternsOf(const ConfusionMatrix& matrix) {
    int enchanters = 0;
    for (std::size_t i = 0; i < matrix.stimuli(); ++i) {
        const auto pattern = parsePatternLabel(matrix.label(i));
        if (!pattern) return std::to_string(matrix.stimuli()) + " stimuli";
        for (int k = 0; k < pattern->count; ++k)
            enchanters = std::max(enchanters, pattern->enchanters[static_cast<std::size_t>(k)] + 1);
    }
    return std::to_string(matrix.stimuli()) + " patterns on " +
           counted(static_cast<std::size_t>(enchanters), "actuator");
}

std::string nameOr(const std::string& name, const char* other) { return name.empty() ? other : name; }

} // namespace

void analyseConfusion(const StudyData<IdentificationTrial>& data, const Findings& to) {
    auto& [job, report, out, table] = to;
    ExportTable each{"confusion-participants", data.isSimulated,
                     "condition,participant,trials,percent_correct,it_bits,corrected_it_bits"};
    ExportTable summary{
        "confusion", data.isSimulated,
        "condition,stimuli,trials,chance_percent,percent_correct,participants,mean_percent,standard_"
        "deviation,least_percent,most_percent,interval,it_bits,corrected_it_bits,most_bits,fano_bits,mean_"
        "own_bits,deviation_own_bits"};
    std::vector<std::pair<std::string, ConfusionMatrix>> matrices;
    for (const auto& condition : data.conditions) {
        const ConfusionMatrix matrix{condition.trials};
        const InformationTransfer it = informationTransfer(matrix);
        const std::string prefix = condition.name.empty() ? "" : cleanLine(condition.name) + ": ";
        for (const auto& words : matrixWarnings(matrix, it)) report.warnings.push_back(prefix + words);
        const auto people = transferByParticipant(condition.trials),
                   compared = comparable(people, matrix.stimuli());
        summarise(summary, condition.name, matrix, it, compared, chanceOf(matrix, job.tolerance));
        const bool isOfAll = compared.size() == people.size();
        const std::string lacking =
            exportPeople(condition.name, people, matrix.stimuli(), isOfAll, table, each);
        if (!lacking.empty())
            report.warnings.push_back(prefix + "stimuli are lacking of " + lacking +
                                      (isOfAll ? "" : ", left out of means of participants"));
        matrices.emplace_back(nameOr(condition.name, "all trials"), matrix);
    }
    report.participants = each.text();
    report.summary = summary.text();
    report.picture = [matrices, isSimulated = data.isSimulated] {
        std::vector<std::string> charts;
        for (const auto& [name, matrix] : matrices)
            charts.push_back(confusionChart({chartName(charts.size()), name, isSimulated}, matrix));
        return chartSheet(charts);
    };
}

void analyseIcons(const StudyData<IdentificationTrial>& data, const Findings& to) {
    auto& [job, report, out, table] = to;
    out << job.meanings << " meanings need " << bits(bitsFor(job.meanings)) << '\n';
    std::vector<std::pair<std::string, ConfusionMatrix>> matrices;
    for (const auto& condition : data.conditions)
        matrices.emplace_back(condition.name, ConfusionMatrix{condition.trials});
    std::ranges::stable_sort(matrices, {}, [](const auto& m) { return m.second.stimuli(); });
    BarChart icons{{chartName(0), "Tactile icons: ", data.isSimulated}, "stimulus", "correct (%)"};
    icons.most = 100.0;
    for (const auto& [name, matrix] : matrices) {
        const InformationTransfer it = informationTransfer(matrix);
        const bool isEnough = it.bestBits() >= bitsFor(job.meanings);
        out << cleanLine(nameOr(name, "all trials")) << ": " << patternsOf(matrix) << ", "
            << bits(it.bestBits()) << ": " << (isEnough ? "enough" : "too little") << '\n';
        if (!isEnough || !icons.groups.empty()) continue;
        icons.frame.title += nameOr(name, "all trials");
        for (const std::size_t i : leastConfused(matrix, job.meanings)) {
            const double share = shareCorrect(matrix, i);
            out << "  " << cleanLine(matrix.label(i)) << "  " << percent(share) << " % correct\n";
            table.row(name, matrix.label(i), 100.0 * share);
            icons.add(matrix.label(i), ChartValue::around(100.0 * share));
        }
    }
    if (icons.groups.empty())
        report.error = job.files.front() + ": expected a condition that transfers " +
                       bits(bitsFor(job.meanings)) + ", found none";
    report.picture = [icons] { return barChart(icons); };
}

// Analyses of pointing as text and tables: errors (means over participants of means over targets), perceptual
// resolution, percent counts.

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
        summary.row(condition, name, trials.size(), own.n, own.mean, onlyIf(hasSpread, own.deviation),
                    onlyIf(hasSpread, own.least()), onlyIf(hasSpread, own.most()));
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
                         one.constantX, one.constantY, onlyIf(one.trials > 1, one.variable), one.distance);
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
