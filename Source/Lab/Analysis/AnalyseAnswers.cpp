// SPDX-License-Identifier: MIT
// Analyses of choices, ratings and levels, and of functions fitted to them, as text and tables.
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace physvib {
namespace {

std::string conditionPrefix(const std::string& condition) {
    return condition.empty() ? "" : cleanLine(condition) + ": ";
}

void addWarning(AnalysisReport& report, const std::string& condition, const std::string& participant,
                const std::string& text) {
    report.warnings.push_back(conditionPrefix(condition) + "participant " + cleanLine(participant) + text);
}

const char* kindLabel(LevelTrial::Kind kind) {
    if (kind == LevelTrial::Kind::staircase) return "threshold by staircase (dB)";
    if (kind == LevelTrial::Kind::quest)
        return "threshold by QUEST+ (dB; interval: t and error of the widths)";
    return kind == LevelTrial::Kind::adjustment ? "level that was set (dB)"
                                                : "geometric mean magnitude (SD of log10)";
}

/// True if scores are ordinal: points by the protocol, else whole numbers from 1 to 7.
bool isOrdinal(const AnalysisJob& job, const RatingData& data, std::size_t scale) {
    if (job.protocol)
        return std::ranges::any_of(job.protocol->sessions, [&](const SessionPlan& session) {
            const auto scores = session.scores();
            return session.points > 0 && std::ranges::find(scores, data.scales[scale]) != scores.end();
        });
    return std::ranges::all_of(data.groups, [&](const auto& session) {
        return std::ranges::all_of(session.trials, [&](const RatingTrial& trial) {
            const double score = trial.scores[scale];
            return std::isnan(score) || (score == std::round(score) && score >= 1.0 && score <= 7.0);
        });
    });
}

} // namespace

std::vector<RatingSummary> withoutOrdinalIntervals(std::vector<RatingSummary> summaries,
                                                   const AnalysisJob& job, const RatingData& data) {
    for (std::size_t s = 0; s < data.scales.size(); ++s)
        if (isOrdinal(job, data, s))
            for (RatingSummary& summary : summaries) summary.halfIntervals[s] = 0.0;
    return summaries;
}

void analyseChoices(const StudyData<ChoiceTrial>& data, const AnalysisOutput& output) {
    auto& [job, report, out, table] = output;
    for (const auto& summary : summariseSessions(data, summariseChoices))
        for (const auto& share : summary.shares) {
            const bool isKnown = !std::isnan(share.share);
            table.cells(summary.condition, share.alternative, std::size_t{share.hits},
                        std::size_t{share.trials}, share.participants, valueIf(isKnown, 100.0 * share.share),
                        valueIf(isKnown, 100.0 * share.median));
            if (share.interval)
                table.row(100.0 * share.interval->lower, 100.0 * share.interval->upper,
                          share.participants > 1 ? "of the median, by ranks" : "over trials, Wilson's");
            else
                table.row("", "", "");
        }
    report.picture = [data] {
        std::vector<std::string> charts;
        for (const auto& [name, trials] : data.groups)
            charts.push_back(
                sharesChart({chartName(charts.size()), nameInSession("Shares of the alternatives", name),
                             data.isSimulated},
                            summariseChoices(trials)));
        return chartSheet(charts);
    };
}

void analyseRatings(const RatingData& data, const AnalysisOutput& output) {
    auto& [job, report, out, table] = output;
    const auto& scales = data.scales;
    const auto summaries = withoutOrdinalIntervals(summariseSessions(data, summariseRatings), job, data);
    std::map<std::array<std::string, 3>, std::size_t> missingScores; // session, participant, scale
    for (const auto& session : data.groups)
        for (std::size_t s = 0; s < scales.size(); ++s) {
            const auto isEmpty = [s](const RatingTrial& trial) { return std::isnan(trial.scores[s]); };
            if (!std::ranges::all_of(session.trials, isEmpty))
                for (const RatingTrial& trial : session.trials)
                    if (isEmpty(trial)) ++missingScores[{session.name, trial.participant, scales[s]}];
        }
    for (const auto& [key, count] : missingScores)
        report.warnings.push_back(nameInSession("participant " + key[1], key[0]) + ": " +
                                  plural(count, "trial") + " without a score of " + cleanLine(key[2]));
    for (const auto& summary : summaries)
        for (std::size_t s = 0; s < scales.size(); ++s) {
            if (std::isnan(summary.means[s])) continue;
            const double deviation = summary.deviations[s], halfInterval = summary.halfIntervals[s];
            table.row(summary.condition, scales[s], summary.scoreCounts[s], summary.raterCounts[s],
                      summary.means[s], summary.medians[s], valueIf(deviation > 0.0, deviation),
                      valueIf(halfInterval > 0.0, halfInterval));
        }
    report.picture = [scales, summaries, isSimulated = data.isSimulated] {
        return scoresChart({chartName(0), "Mean scores", isSimulated}, scales, summaries);
    };
}

void analyseLevels(const StudyData<LevelTrial>& data, const AnalysisOutput& output) {
    auto& [job, report, out, table] = output;
    const auto summaries = summariseLevels(data.groups.front().trials);
    ExportTable thresholdTable{"thresholds", data.isSimulated, "method,condition,participant,threshold"};
    for (const LevelSummary& s : summaries) {
        if (job.memoryTables == nullptr) // a report lists them itself
            for (const auto& [participant, reason] : s.excluded)
                addWarning(report, s.condition, participant, " left out: " + reason);
        for (const auto& [participant, threshold] : s.thresholds)
            thresholdTable.row(s.kind == LevelTrial::Kind::quest ? "quest" : "staircase", s.condition,
                               participant, threshold);
        // a single value has no spread
        table.row(kindLabel(s.kind), s.condition, s.stimulus, s.trials, s.participants,
                  valueIf(!std::isnan(s.estimate), s.estimate), valueIf(s.deviation > 0.0, s.deviation),
                  valueIf(s.halfInterval > 0.0, s.halfInterval));
    }
    report.participants = thresholdTable.text();
    report.picture = [summaries, isSimulated = data.isSimulated] {
        using Kind = LevelTrial::Kind;
        std::vector<std::string> charts;
        for (const Kind kind : {Kind::staircase, Kind::adjustment, Kind::magnitude, Kind::quest})
            charts.push_back(
                levelChart({chartName(charts.size()), kindLabel(kind), isSimulated}, summaries, kind));
        std::erase(charts, std::string{});
        return chartSheet(charts);
    };
}

namespace {

using LevelAnswers = StudyData<LevelAnswer>;

Result<LevelAnswers> readColumns(const AnalysisJob& job, LevelAnswerColumns columns) {
    if (!job.level.empty()) columns.level = job.level;
    if (!job.measure.empty()) columns.measure = job.measure;
    return readStudyFiles(
        job, [&](const std::vector<NamedText>& files) { return readLevelAnswers(files, columns); });
}

/// A row of a summary: mean, standard deviation and interval over participants. An interval of a
/// positive measure that would reach below 0 is omitted.
void summarise(ExportTable& summary, const std::string& condition, const std::string& measure,
               const std::vector<double>& values, bool isPositive = false) {
    if (values.empty()) return;
    const Moments moments{values};
    const bool hasSpread = moments.deviation > 0.0,
               hasInterval = hasSpread && (!isPositive || moments.lowerLimit() > 0.0);
    summary.row(condition, measure, moments.n, moments.mean, valueIf(hasSpread, moments.deviation),
                valueIf(hasInterval, moments.lowerLimit()), valueIf(hasInterval, moments.upperLimit()));
}

constexpr const char* summaryColumns =
    "condition,measure,participants,mean,standard_deviation,interval_least,interval_most";

/// True if the share is four standard errors below the guess rate.
bool isBelowGuess(const LevelCount& count, double guess) {
    const auto n = static_cast<double>(count.trials);
    return guess > 0.0 &&
           static_cast<double>(count.hits) - n * guess < -4.0 * std::sqrt(n * guess * (1.0 - guess));
}

void reportMissingFits(const AnalysisOutput& output) {
    output.report.error = output.job.files.front() + ": nobody can be fitted";
    for (const std::string& warning : std::exchange(output.report.warnings, {}))
        output.report.error += "; " + warning;
}

/// Chart of the first condition; reports have charts of all.
ChartFrame makeFrame(const AnalysisJob& job, const std::string& condition, bool isSimulated) {
    return {"fit",
            condition.empty() ? std::filesystem::path{job.files.front()}.filename().string() : condition,
            isSimulated};
}

} // namespace

Result<LevelAnswers> readAnswers(const AnalysisJob& job) {
    return readColumns(job, {"level_db", "correct", false});
}
Result<LevelAnswers> readMagnitudes(const AnalysisJob& job) {
    return readColumns(job, {"stimulus", "value", true});
}

void analysePsychometric(const LevelAnswers& data, const AnalysisOutput& output) {
    auto& [job, report, out, table] = output;
    bool isFitted = false;
    const FitLabels labels = fitLabels(job.columns, job.level, job.measure);
    ExportTable summary{"psychometric", data.isSimulated, summaryColumns};
    for (const auto& condition : data.groups) {
        std::vector<double> thresholds, jnds;
        for (const LevelCount& count :
             countByLevel(condition.trials, [](const LevelAnswer& trial) { return trial.levelAndHit(); }))
            if (isBelowGuess(count, job.model.guess)) {
                report.warnings.push_back(conditionPrefix(condition.name) + "answers at " +
                                          plainNumber(count.level) + " lie far below the guess rate of " +
                                          percentNumber(job.model.guess) + " % (--guess)");
                break;
            }
        for (const auto& entry : psychometricByParticipant(condition.trials, job.model)) {
            if (!entry.fit.error.empty()) {
                addWarning(report, condition.name, entry.participant, " left out: " + entry.fit.error);
                continue;
            }
            const PsychometricFunction& f = entry.fit.function;
            thresholds.push_back(f.threshold);
            if (entry.fit.hasJnd)
                jnds.push_back(f.jnd());
            else
                addWarning(report, condition.name, entry.participant,
                           ": thresholds from " + displayCell(plainNumber(entry.fit.stepThresholds.first)) +
                               " to " + displayCell(plainNumber(entry.fit.stepThresholds.second)) +
                               " fit as well, of functions as steep as one likes: no " +
                               labels.slopeName(job.model) + "; " + labels.midpointName(job.model) +
                               ": the middle");
            table.row(condition.name, entry.participant, entry.trials, f.threshold,
                      valueIf(entry.fit.hasJnd, f.width), valueIf(entry.fit.hasJnd, f.jnd()), f.guess,
                      f.lapse, entry.fit.logLikelihood);
        }
        if (thresholds.empty()) continue;
        isFitted = true;
        summarise(summary, condition.name, labels.midpointName(job.model), thresholds);
        summarise(summary, condition.name, labels.slopeName(job.model), jnds, true);
    }
    if (!isFitted) return reportMissingFits(output);
    report.summary = summary.text();
    const auto& first = data.groups.front();
    report.picture = [first, model = job.model, labels,
                      frame = makeFrame(job, first.name, report.isSimulated)] {
        return psychometricChart(frame, first.trials, model, labels);
    };
}

void analysePowerLaw(const LevelAnswers& data, const AnalysisOutput& output) {
    auto& [job, report, out, table] = output;
    bool isFitted = false;
    ExportTable summary{"power-law", data.isSimulated, summaryColumns};
    for (const auto& condition : data.groups) {
        std::vector<double> exponents;
        for (const auto& entry : powerLawByParticipant(condition.trials)) {
            if (!entry.fit.error.empty()) {
                addWarning(report, condition.name, entry.participant, " left out: " + entry.fit.error);
                continue;
            }
            exponents.push_back(entry.fit.exponent);
            table.row(condition.name, entry.participant, entry.trials, entry.fit.exponent, entry.fit.factor,
                      entry.fit.rSquared);
        }
        if (exponents.empty()) continue;
        isFitted = true;
        summarise(summary, condition.name, "exponent", exponents);
    }
    if (!isFitted) return reportMissingFits(output);
    report.summary = summary.text();
    const auto& first = data.groups.front();
    report.picture = [first, level = job.level.empty() ? std::string("level") : job.level,
                      frame = makeFrame(job, first.name, report.isSimulated)] {
        return powerLawChart(frame, first.trials, level);
    };
}

} // namespace physvib
