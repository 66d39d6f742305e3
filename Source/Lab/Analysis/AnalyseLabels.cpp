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
        words.push_back("stimuli were not answered equally often: " + cleanLine(matrix.label(at)) + " " +
                        std::to_string(fewest) + " times, others up to " + std::to_string(most));
    }
    if (matrix.responses() > matrix.stimuli())
        words.push_back(
            "responses that are no stimulus count as wrong: " + cleanLine(matrix.label(matrix.stimuli())) +
            (matrix.responses() > matrix.stimuli() + 1 ? " and others" : ""));
    if (matrix.stimuli() == 1) words.push_back("only one stimulus: nothing can be transferred");
    if (!it.canBeCorrected())
        words.push_back(fixedNumber(it.trialsPerCell, 2) + " trials per cell, expected at least " +
                        fixedNumber(trialsPerCellForCorrection, 0) +
                        ": IT is biased upward and its correction overshoots; Fano's bound is given instead");
    return words;
}

/// Trials of one person depend on each other: the interval is over people where there are several.
std::string correctWords(const ConfusionMatrix& matrix, const std::vector<ParticipantTransfer>& people) {
    const Proportion correct = proportion(matrix.correct(), matrix.trials());
    const std::string share = percent(correct.share);
    if (people.size() < 2)
        return share + " (95 % interval over trials " + percent(correct.least) + " to " +
               percent(correct.most) + ")";
    std::vector<double> shares;
    for (const ParticipantTransfer& own : people)
        shares.push_back(static_cast<double>(own.matrix.correct()) /
                         static_cast<double>(own.matrix.trials()));
    const Moments moments{shares};
    const std::string mean = share + "; mean of participants " + percent(moments.mean);
    if (moments.halfInterval() == 0.0)
        return mean + " (" + counted(people.size(), "participant") + ", all the same)";
    return mean + " (95 % interval over " + counted(people.size(), "participant") + " " +
           percent(std::max(0.0, moments.least())) + " to " + percent(std::min(1.0, moments.most())) +
           (moments.least() < 0.0 || moments.most() > 1.0 ? ", cut at 0 and 100 %)" : ")");
}

void tell(std::ostream& out, const std::string& indent, const ConfusionMatrix& matrix,
          const InformationTransfer& it, const std::vector<ParticipantTransfer>& people) {
    out << indent << "trials: " << matrix.trials() << " (" << matrix.stimuli() << " stimuli)\n"
        << indent << "percent correct: " << correctWords(matrix, people) << '\n'
        << indent << "IT: " << bits(it.bits) << " of " << bits(it.mostBits) << '\n';
    if (it.canBeCorrected())
        out << indent << "corrected IT: " << bits(it.correctedBits())
            << ", less Miller's bias, (cells - rows - columns + 1) / (2 N ln 2) of those with answers\n";
    else
        out << indent << "IT bound: at least " << bits(it.leastBits) << " (Fano)\n";
    out << indent << (it.canBeCorrected() ? "2^corrected IT: " : "2^IT: ")
        << fixedNumber(std::exp2(it.bestBits()), 1) << '\n';
}

/// Each participant in both tables; their mean information transfer, and who lacks stimuli, as text.
void tellAndExport(std::ostream& out, const std::string& indent, const std::string& condition,
                   const std::vector<ParticipantTransfer>& people, std::size_t stimuli, bool isOfAll,
                   ExportTable& counts, ExportTable& each) {
    std::vector<double> transferred;
    std::size_t corrected = 0, fewest = people.front().matrix.trials(), most = fewest;
    std::string lacking;
    for (const auto& [participant, matrix, transfer] : people) {
        for (std::size_t i = 0; i < matrix.stimuli(); ++i)
            for (std::size_t j = 0; j < matrix.responses(); ++j)
                counts.row(condition, participant, matrix.label(i), matrix.label(j),
                           std::size_t{matrix.count(i, j)});
        const bool isWhole = matrix.stimuli() == stimuli;
        const double share = static_cast<double>(matrix.correct()) / static_cast<double>(matrix.trials());
        each.row(condition, participant, std::size_t{matrix.trials()},
                 isWhole || isOfAll ? std::optional{100.0 * share} : std::nullopt, transfer.bits,
                 transfer.canBeCorrected() ? std::optional{transfer.correctedBits()} : std::nullopt);
        fewest = std::min<std::size_t>(fewest, matrix.trials()),
        most = std::max<std::size_t>(most, matrix.trials());
        if (isWhole)
            transferred.push_back(transfer.bestBits()), corrected += transfer.canBeCorrected();
        else
            lacking += (lacking.empty() ? "" : ", ") + cleanLine(participant);
    }
    if (fewest < most)
        out << indent << "people have " << fewest << " to " << most
            << " trials, by whose number they count in IT\n";
    const Moments moments{transferred};
    if (moments.n > 1)
        out << indent << "IT of participants: mean " << bits(moments.mean) << ", standard error "
            << bits(moments.standardError()) << ", " << moments.n << " participants, "
            << (corrected == moments.n ? "corrected\n"
                : corrected == 0       ? "not corrected\n"
                                       : "corrected where there are trials enough\n");
    if (!lacking.empty())
        out << indent << "stimuli are lacking of " << lacking
            << (isOfAll ? ": each counts with those that there are\n"
                        : ": left out of means of participants\n");
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

/// What guessing would come to, where near answers count as right.
void tellChance(std::ostream& out, const std::string& indent, const ConfusionMatrix& matrix, int tolerance) {
    std::vector<IdentificationTrial> guessed;
    for (std::size_t i = 0; i < matrix.stimuli(); ++i)
        for (std::size_t j = 0; j < matrix.stimuli(); ++j)
            guessed.push_back({matrix.label(i), matrix.label(j)});
    const ConfusionMatrix chance{withTolerance(std::move(guessed), tolerance)};
    out << indent << "answers within " << counted(static_cast<std::size_t>(tolerance), "step")
        << " count as the stimulus: by chance "
        << percent(proportion(chance.correct(), chance.trials()).share) << " % and "
        << bits(informationTransfer(chance).bits) << '\n';
}

std::string nameOr(const std::string& name, const char* other) { return name.empty() ? other : name; }

} // namespace

void analyseConfusion(const StudyData<IdentificationTrial>& data, const Findings& to) {
    auto& [job, report, out, table] = to;
    ExportTable each{"confusion-participants", data.isSimulated,
                     "condition,participant,trials,percent_correct,it_bits,corrected_it_bits"};
    std::vector<std::pair<std::string, ConfusionMatrix>> matrices;
    for (const auto& condition : data.conditions) {
        const ConfusionMatrix matrix{condition.trials};
        const InformationTransfer it = informationTransfer(matrix);
        const std::string prefix = condition.name.empty() ? "" : cleanLine(condition.name) + ": ";
        for (const auto& words : matrixWarnings(matrix, it)) report.warnings.push_back(prefix + words);
        if (!condition.name.empty()) out << cleanLine(condition.name) << '\n';
        const char* const indent = condition.name.empty() ? "" : "  ";
        const auto people = transferByParticipant(condition.trials),
                   compared = comparable(people, matrix.stimuli());
        tell(out, indent, matrix, it, compared);
        if (job.tolerance > 0) tellChance(out, indent, matrix, job.tolerance);
        tellAndExport(out, indent, condition.name, people, matrix.stimuli(), compared.size() == people.size(),
                      table, each);
        matrices.emplace_back(nameOr(condition.name, "all trials"), matrix);
    }
    report.participants = each.text();
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
