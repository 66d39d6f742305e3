// SPDX-License-Identifier: MIT
// Statistical tests over participants: one line per effect, as text and as a tidy table.
#include "Lab/Analysis/Analyses.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Analysis/FitCharts.h"
#include "Lab/Files/LongTableCsv.h"
#include "Lab/Statistics/Pairs.h"
#include "Lab/Statistics/RankTests.h"
#include "Lab/Statistics/ShapiroWilk.h"
#include <cmath>
#include <sstream>

namespace physvib {
namespace {

std::string degrees(double df) { return fixedNumber(df, df == std::round(df) ? 0 : 2); }

std::string statisticWords(const TestReport& report, const TestLine& line) {
    std::string words = report.statistic;
    if (line.df1)
        words.append("(")
            .append(degrees(*line.df1))
            .append(line.df2 ? ", " + degrees(*line.df2) : "")
            .append(")");
    return words + " = " + fixedNumber(*line.statistic, 3) + ", " + chanceWords(*line.p);
}

void tell(std::ostream& out, const TestReport& report, const TestLine& line) {
    out << cleanLine(line.effect) << ": " << statisticWords(report, line);
    const bool isCorrected = line.pCorrected && !report.correction.empty();
    if (isCorrected) out << ", " << report.correction << ' ' << chanceWords(*line.pCorrected);
    if (line.differenceInterval) {
        const auto& [least, most] = *line.differenceInterval;
        const int decimals = decimalsOf(most - least);
        out << ", difference " << fixedNumber(*line.difference, decimals) << " (95 % interval "
            << fixedNumber(least, decimals) << " to " << fixedNumber(most, decimals) << ")";
    }
    if (line.effectSize) out << ", " << report.effectSize << " = " << fixedNumber(*line.effectSize, 3);
    if (line.effectInterval)
        out << " (95 % interval " << fixedNumber(line.effectInterval->least, 3) << " to "
            << fixedNumber(line.effectInterval->most, 3) << ")";
    out << ", n = " << line.n << '\n';
}

std::string exported(const std::string& name, bool isSimulated, const TestReport& report) {
    ExportTable table{name, isSimulated,
                      "effect,df1,df2,statistic,p,p_corrected,epsilon,effect_size,n,effect_least,effect_most,"
                      "difference,difference_least,difference_most"};
    const auto bound = [](const std::optional<Interval95>& interval, double Interval95::*end) {
        return interval ? std::optional{(*interval).*end} : std::nullopt;
    };
    for (const TestLine& line : report.lines) {
        table.cell(line.effect);
        for (const auto& number :
             {line.df1, line.df2, line.statistic, line.p, line.pCorrected, line.epsilon, line.effectSize})
            table.cell(number);
        table.row(line.n, bound(line.effectInterval, &Interval95::least),
                  bound(line.effectInterval, &Interval95::most), line.difference,
                  bound(line.differenceInterval, &Interval95::least),
                  bound(line.differenceInterval, &Interval95::most));
    }
    return table.text();
}

/// Reads the design, runs `test` and prints its lines.
template <class Test>
AnalysisReport analyseDesign(const AnalysisJob& o, const std::string& name, Test test) {
    const LongTableColumns columns{o.measure, o.within, o.between, o.participant, o.where};
    const auto data = readStudyFiles(
        o, [&](const std::vector<NamedText>& files) { return readLongTable(files, columns); },
        limits::maxLongTableBytes);
    if (!data) return {data.error};
    const Design design = Design::of(data.value.table);
    TestReport tested = test(design);
    if (!tested.fault.empty()) return {o.files.front() + ": " + cleanLine(tested.fault)};
    if (tested.correction.empty() && o.correction) correctForNumber(tested, *o.correction);
    AnalysisReport report{{}, data.value.isSimulated, data.value.warnings};
    for (const auto& words : design.warnings) report.warnings.push_back(cleanLine(words));
    std::ostringstream out;
    for (const auto& note : tested.notes) out << note << '\n';
    for (const TestLine& line : tested.lines) tell(out, tested, line);
    report.words = out.str();
    report.table = exported(name, report.isSimulated, tested);
    report.lines = std::move(tested.lines);
    return report;
}

} // namespace

AnalysisReport analyseFriedman(const AnalysisJob& o) { return analyseDesign(o, "friedman", friedman); }
AnalysisReport analyseWilcoxon(const AnalysisJob& o) { return analyseDesign(o, "wilcoxon", wilcoxon); }
AnalysisReport analyseMannWhitney(const AnalysisJob& o) {
    return analyseDesign(o, "mann-whitney", mannWhitney);
}
AnalysisReport analyseKruskalWallis(const AnalysisJob& o) {
    return analyseDesign(o, "kruskal-wallis", kruskalWallis);
}
AnalysisReport analyseShapiro(const AnalysisJob& o) { return analyseDesign(o, "shapiro", shapiroByCell); }

AnalysisReport analysePairs(const AnalysisJob& o) {
    return analyseDesign(o, "pairs", [&](const Design& design) {
        return pairs(design, o.pairTest, o.correction.value_or(Correction::holm));
    });
}

} // namespace physvib
