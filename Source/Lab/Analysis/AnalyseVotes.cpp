// SPDX-License-Identifier: MIT
// Analyses of choices, ratings and levels, as text and tables.
#include "Lab/Analysis/Analyses.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Analysis/StudyCharts.h"
#include <algorithm>
#include <sstream>

namespace physvib {
namespace {

void tell(std::ostream& out, const ChoiceSummary& summary) {
    out << wholeLabel(summary.condition) << ':';
    for (const ChoiceShare& share : summary.shares)
        out << (&share == &summary.shares.front() ? " " : ", ") << printable(share.alternative) << ' '
            << percent(share.share) << " % (" << percent(share.least) << " to " << percent(share.most) << ')';
    out << ", " << counted(summary.trials, "trial") << " of " << counted(summary.participants, "participant");
    out << '\n';
}

const char* kindWord(LevelTrial::Kind kind) {
    if (kind == LevelTrial::Kind::staircase) return "threshold";
    if (kind == LevelTrial::Kind::quest) return "threshold by QUEST+";
    return kind == LevelTrial::Kind::adjustment ? "matched at" : "magnitude";
}

void tell(std::ostream& out, const LevelSummary& s) {
    const bool isMagnitude = s.kind == LevelTrial::Kind::magnitude;
    out << wholeLabel(s.condition) << (s.stimulus.empty() ? "" : ", " + wholeLabel(s.stimulus)) << ": "
        << kindWord(s.kind) << ' ' << fixedNumber(s.estimate, isMagnitude ? 2 : 1)
        << (isMagnitude ? "" : " dB");
    const bool isThreshold = s.kind == LevelTrial::Kind::staircase || s.kind == LevelTrial::Kind::quest;
    if (s.deviation > 0.0)
        out << " (standard deviation " << fixedNumber(s.deviation, 2) << (isMagnitude ? " of log10" : " dB")
            << (isThreshold ? " over participants)" : " over trials)");
    if (s.halfInterval > 0.0)
        out << ", 95 % interval " << fixedNumber(s.estimate - s.halfInterval, 1) << " to "
            << fixedNumber(s.estimate + s.halfInterval, 1) << " dB"
            << (s.participants > 1 ? " over participants" : " of what is still possible");
    out << ", " << counted(s.trials, "trial") << " of " << counted(s.participants, "participant");
    if (s.kind == LevelTrial::Kind::staircase)
        out << ", " << s.reversals << " reversals that a trial followed";
    out << '\n';
}

template <class Summary>
std::vector<const Summary*> pointersTo(const std::vector<Summary>& summaries) {
    std::vector<const Summary*> pointers;
    for (const Summary& summary : summaries) pointers.push_back(&summary);
    return pointers;
}

} // namespace

AnalysisReport analyseChoices(const AnalysisJob& o) {
    const auto data = readStudyFiles(o, readChoices);
    if (!data) return {data.error};
    const auto summaries = summariseChoices(data.value.conditions.front().trials);
    ExportTable table{"choices", data.value.isSimulated,
                      "condition,alternative,votes,trials,percent,least_percent,most_percent,participants,"
                      "participants_median_percent"};
    AnalysisReport report{{}, data.value.isSimulated, data.value.warnings};
    std::ostringstream out;
    if (summaries.front().participants == 1)
        report.warnings.push_back("one participant, or no column participant: intervals are over trials, and "
                                  "say nothing about other people");
    if (summaries.front().shares.size() == 1)
        report.warnings.push_back("every choice is " +
                                  printable(summaries.front().shares.front().alternative) +
                                  ": nothing to compare");
    for (const auto& summary : summaries) {
        tell(out, summary);
        for (const auto& share : summary.shares) {
            table.row(summary.condition, share.alternative, std::size_t{share.hits},
                      std::size_t{summary.trials}, 100.0 * share.share, 100.0 * share.least,
                      100.0 * share.most, summary.participants, 100.0 * share.median);
        }
    }
    report.words = out.str();
    report.table = table.text();
    report.picture = [summaries, isSimulated = report.isSimulated] {
        std::vector<std::string> groups;
        for (const ChoiceSummary& summary : summaries) groups.push_back(summary.condition);
        return sharesChart({chartName(0), "Shares of the alternatives", isSimulated}, "condition", groups,
                           pointersTo(summaries));
    };
    return report;
}

AnalysisReport analyseRatings(const AnalysisJob& o) {
    const auto ratings = readStudyFiles(o, readRatings);
    if (!ratings) return {ratings.error};
    const auto& [scales, data] = ratings.value;
    const auto summaries = summariseRatings(data.conditions.front().trials);
    ExportTable table{"ratings", data.isSimulated,
                      "condition,scale,trials,participants,mean,standard_deviation,half_interval"};
    AnalysisReport report{{}, data.isSimulated, data.warnings};
    std::ostringstream out;
    bool hasIntervals = false;
    for (const auto& summary : summaries) {
        hasIntervals |= std::ranges::any_of(summary.halfIntervals, [](double half) { return half > 0.0; });
        out << wholeLabel(summary.condition) << ": " << counted(summary.trials, "trial");
        for (std::size_t s = 0; s < scales.size(); ++s) {
            out << ", " << printable(scales[s]) << ' ' << fixedNumber(summary.means[s], 1);
            if (summary.halfIntervals[s] > 0.0) out << " +- " << fixedNumber(summary.halfIntervals[s], 1);
            table.row(summary.condition, scales[s], summary.trials, summary.participants, summary.means[s],
                      summary.deviations[s], summary.halfIntervals[s]);
        }
        out << '\n';
    }
    if (hasIntervals) out << "+-: half of the 95 % interval over participants\n";
    report.words = out.str();
    report.table = table.text();
    report.picture = [scales = scales, summaries, isSimulated = report.isSimulated] {
        return scoresChart({chartName(0), "Mean scores", isSimulated}, scales, pointersTo(summaries));
    };
    return report;
}

AnalysisReport analyseLevels(const AnalysisJob& o) {
    const auto data = readStudyFiles(o, readLevels);
    if (!data) return {data.error};
    const auto summaries = summariseLevels(data.value.conditions.front().trials);
    ExportTable table{
        "levels", data.value.isSimulated,
        "kind,condition,stimulus,trials,participants,reversals,estimate,standard_deviation,half_interval"};
    ExportTable each{"thresholds", data.value.isSimulated, "method,condition,participant,threshold"};
    AnalysisReport report{{}, data.value.isSimulated, data.value.warnings};
    std::ostringstream out;
    for (const LevelSummary& s : summaries) {
        tell(out, s);
        if (s.flatRuns > 0)
            report.warnings.push_back(printable(s.condition) + ": " + std::to_string(s.flatRuns) +
                                      (s.flatRuns == 1 ? " staircase has" : " staircases have") +
                                      " fewer than two reversals: the level of the last trial "
                                      "stands for a threshold");
        for (const auto& [participant, threshold] : s.thresholds)
            each.row(s.kind == LevelTrial::Kind::quest ? "quest" : "staircase", s.condition, participant,
                     threshold);
        table.row(kindWord(s.kind), s.condition, s.stimulus, s.trials, s.participants, s.reversals,
                  s.estimate, s.deviation, s.halfInterval);
    }
    report.words = out.str();
    report.table = table.text();
    report.participants = each.text();
    report.picture = [summaries, isSimulated = report.isSimulated] {
        return chartSheet(levelCharts(summaries, isSimulated));
    };
    return report;
}

} // namespace physvib
