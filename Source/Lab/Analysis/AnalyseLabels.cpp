// SPDX-License-Identifier: MIT
// Analyses of identification: confusion matrices, information transfer and icons, as text and tables.
#include "Io/Text/CleanText.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Summaries.h"
#include "Stimuli/PulsePattern.h"
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
    constexpr auto known = ExportTable::onlyIf;
    std::vector<double> shares, bits;
    for (const ParticipantTransfer& own : people) {
        shares.push_back(100.0 * static_cast<double>(own.matrix.correct()) /
                         static_cast<double>(own.matrix.trials()));
        if (own.matrix.stimuli() == matrix.stimuli()) bits.push_back(own.transfer.bits);
    }
    const Moments moments{shares}, transferred{bits};
    const bool hasSpread = moments.deviation > 0.0, isAlone = people.size() < 2;
    summary.row(condition, matrix.stimuli(), std::size_t{matrix.trials()}, chancePercent, 100.0 * all.share,
                people.size(), known(!isAlone, moments.mean), known(hasSpread, moments.deviation),
                known(isAlone || hasSpread, isAlone ? 100.0 * all.least : std::max(0.0, moments.least())),
                known(isAlone || hasSpread, isAlone ? 100.0 * all.most : std::min(100.0, moments.most())),
                isAlone     ? "over trials, Wilson's"
                : hasSpread ? "t, cut at 0 and 100"
                            : "",
                it.bits, known(it.canBeCorrected(), it.correctedBits()), it.mostBits, it.leastBits,
                known(transferred.n > 1, transferred.mean), known(transferred.n > 1, transferred.deviation));
}

/// Each participant in both tables; who lacks stimuli.
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
                 ExportTable::onlyIf(isWhole || isOfAll, 100.0 * share), transfer.bits,
                 ExportTable::onlyIf(transfer.canBeCorrected(), transfer.correctedBits()));
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

} // namespace physvib
