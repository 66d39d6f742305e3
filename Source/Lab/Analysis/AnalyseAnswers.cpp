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

std::string prefixOf(const std::string& condition) {
    return condition.empty() ? "" : cleanLine(condition) + ": ";
}

void warnOf(AnalysisReport& report, const std::string& condition, const std::string& participant,
            const std::string& words) {
    report.warnings.push_back(prefixOf(condition) + "participant " + cleanLine(participant) + words);
}

const char* kindWord(LevelTrial::Kind kind) {
    if (kind == LevelTrial::Kind::staircase) return "threshold by staircase (dB)";
    if (kind == LevelTrial::Kind::quest)
        return "threshold by QUEST+ (dB; interval: t and error of the widths)";
    return kind == LevelTrial::Kind::adjustment ? "level that was set (dB)"
                                                : "geometric mean magnitude (SD of log10)";
}

/// Scores of so many points have an order and no distances: by the protocol, else whole numbers from 1 to 7.
bool isOfPoints(const AnalysisJob& job, const RatingData& data, std::size_t scale) {
    if (job.protocol)
        return std::ranges::any_of(job.protocol->sessions, [&](const SessionPlan& one) {
            const auto scores = one.scores();
            return one.points > 0 && std::ranges::find(scores, data.scales[scale]) != scores.end();
        });
    return std::ranges::all_of(data.conditions, [&](const auto& session) {
        return std::ranges::all_of(session.trials, [&](const RatingTrial& trial) {
            const double score = trial.scores[scale];
            return std::isnan(score) || (score == std::round(score) && score >= 1.0 && score <= 7.0);
        });
    });
}

} // namespace

std::vector<RatingSummary> withoutIntervalsOfPoints(std::vector<RatingSummary> summaries,
                                                    const AnalysisJob& job, const RatingData& data) {
    for (std::size_t s = 0; s < data.scales.size(); ++s)
        if (isOfPoints(job, data, s))
            for (RatingSummary& summary : summaries) summary.halfIntervals[s] = 0.0;
    return summaries;
}

void analyseChoices(const StudyData<ChoiceTrial>& data, const Findings& to) {
    auto& [job, report, out, table] = to;
    for (const auto& summary : bySession(data, summariseChoices))
        for (const auto& share : summary.shares) {
            const bool isKnown = !std::isnan(share.share);
            table.cells(summary.condition, share.alternative, std::size_t{share.hits},
                        std::size_t{share.trials}, share.participants, onlyIf(isKnown, 100.0 * share.share),
                        onlyIf(isKnown, 100.0 * share.median));
            if (share.interval)
                table.row(100.0 * share.interval->least, 100.0 * share.interval->most,
                          share.participants > 1 ? "of the median, by ranks" : "over trials, Wilson's");
            else
                table.row("", "", "");
        }
    report.picture = [data] {
        std::vector<std::string> charts;
        for (const auto& [name, trials] : data.conditions)
            charts.push_back(sharesChart(
                {chartName(charts.size()), inSession("Shares of the alternatives", name), data.isSimulated},
                summariseChoices(trials)));
        return chartSheet(charts);
    };
}

void analyseRatings(const RatingData& data, const Findings& to) {
    auto& [job, report, out, table] = to;
    const auto& scales = data.scales;
    const auto summaries = withoutIntervalsOfPoints(bySession(data, summariseRatings), job, data);
    std::map<std::array<std::string, 3>, std::size_t> lacking; // session, participant, scale
    for (const auto& session : data.conditions)
        for (std::size_t s = 0; s < scales.size(); ++s) {
            const auto isEmpty = [s](const RatingTrial& trial) { return std::isnan(trial.scores[s]); };
            if (!std::ranges::all_of(session.trials, isEmpty))
                for (const RatingTrial& trial : session.trials)
                    if (isEmpty(trial)) ++lacking[{session.name, trial.participant, scales[s]}];
        }
    for (const auto& [where, count] : lacking)
        report.warnings.push_back(inSession("participant " + where[1], where[0]) + ": " +
                                  counted(count, "trial") + " without a score of " + cleanLine(where[2]));
    for (const auto& summary : summaries)
        for (std::size_t s = 0; s < scales.size(); ++s) {
            if (std::isnan(summary.means[s])) continue;
            const double deviation = summary.deviations[s], half = summary.halfIntervals[s];
            table.row(summary.condition, scales[s], summary.scored[s], summary.raters[s], summary.means[s],
                      summary.medians[s], onlyIf(deviation > 0.0, deviation), onlyIf(half > 0.0, half));
        }
    report.picture = [scales, summaries, isSimulated = data.isSimulated] {
        return scoresChart({chartName(0), "Mean scores", isSimulated}, scales, summaries);
    };
}

void analyseLevels(const StudyData<LevelTrial>& data, const Findings& to) {
    auto& [job, report, out, table] = to;
    const auto summaries = summariseLevels(data.conditions.front().trials);
    ExportTable each{"thresholds", data.isSimulated, "method,condition,participant,threshold"};
    for (const LevelSummary& s : summaries) {
        if (job.made == nullptr) // a report has told them
            for (const auto& [who, why] : s.leftOut) warnOf(report, s.condition, who, " left out: " + why);
        for (const auto& [participant, threshold] : s.thresholds)
            each.row(s.kind == LevelTrial::Kind::quest ? "quest" : "staircase", s.condition, participant,
                     threshold);
        // of one value there is no spread
        table.row(kindWord(s.kind), s.condition, s.stimulus, s.trials, s.participants,
                  onlyIf(!std::isnan(s.estimate), s.estimate), onlyIf(s.deviation > 0.0, s.deviation),
                  onlyIf(s.halfInterval > 0.0, s.halfInterval));
    }
    report.participants = each.text();
    report.picture = [summaries, isSimulated = data.isSimulated] {
        using Kind = LevelTrial::Kind;
        std::vector<std::string> charts;
        for (const Kind kind : {Kind::staircase, Kind::adjustment, Kind::magnitude, Kind::quest})
            charts.push_back(
                levelChart({chartName(charts.size()), kindWord(kind), isSimulated}, summaries, kind));
        std::erase(charts, std::string{});
        return chartSheet(charts);
    };
}

namespace {

using LevelAnswers = StudyData<LevelAnswer>;

Result<LevelAnswers> readColumns(const AnalysisJob& o, LevelAnswerColumns columns) {
    if (!o.level.empty()) columns.level = o.level;
    if (!o.measure.empty()) columns.measure = o.measure;
    return readStudyFiles(
        o, [&](const std::vector<NamedText>& files) { return readLevelAnswers(files, columns); });
}

/// A row of a summary: mean, standard deviation and interval over participants. A measure that is above 0 has
/// no interval that reaches below.
void summarise(ExportTable& summary, const std::string& condition, const std::string& measure,
               const std::vector<double>& values, bool isAboveZero = false) {
    if (values.empty()) return;
    const Moments own{values};
    const bool hasSpread = own.deviation > 0.0,
               hasInterval = hasSpread && (!isAboveZero || own.least() > 0.0);
    summary.row(condition, measure, own.n, own.mean, onlyIf(hasSpread, own.deviation),
                onlyIf(hasInterval, own.least()), onlyIf(hasInterval, own.most()));
}

constexpr const char* summaryColumns =
    "condition,measure,participants,mean,standard_deviation,interval_least,interval_most";

/// True if the share is four standard errors below the guess rate.
bool isBelowGuess(const LevelCount& at, double guess) {
    const auto n = static_cast<double>(at.trials);
    return guess > 0.0 &&
           static_cast<double>(at.hits) - n * guess < -4.0 * std::sqrt(n * guess * (1.0 - guess));
}

void tellNobodyFitted(const Findings& to) {
    to.report.error = to.job.files.front() + ": nobody can be fitted";
    for (const std::string& one : std::exchange(to.report.warnings, {})) to.report.error += "; " + one;
}

/// Chart of the first condition; reports have charts of all.
ChartFrame frameOf(const AnalysisJob& o, const std::string& condition, bool isSimulated) {
    return {"fit", condition.empty() ? std::filesystem::path{o.files.front()}.filename().string() : condition,
            isSimulated};
}

} // namespace

Result<LevelAnswers> readAnswers(const AnalysisJob& o) {
    return readColumns(o, {"level_db", "correct", false});
}
Result<LevelAnswers> readMagnitudes(const AnalysisJob& o) {
    return readColumns(o, {"stimulus", "value", true});
}

void analysePsychometric(const LevelAnswers& data, const Findings& to) {
    auto& [o, report, out, table] = to;
    bool isFitted = false;
    const FitWords words = fitWords(o.columns, o.level, o.measure);
    ExportTable summary{"psychometric", data.isSimulated, summaryColumns};
    for (const auto& condition : data.conditions) {
        std::vector<double> thresholds, jnds;
        for (const LevelCount& at :
             countByLevel(condition.trials, [](const LevelAnswer& one) { return one.counted(); }))
            if (isBelowGuess(at, o.model.guess)) {
                report.warnings.push_back(prefixOf(condition.name) + "answers at " + plainNumber(at.level) +
                                          " lie far below the guess rate of " + percent(o.model.guess) +
                                          " % (--guess)");
                break;
            }
        for (const auto& own : psychometricByParticipant(condition.trials, o.model)) {
            if (!own.fit.fault.empty()) {
                warnOf(report, condition.name, own.participant, " left out: " + own.fit.fault);
                continue;
            }
            const PsychometricFunction& f = own.fit.function;
            thresholds.push_back(f.threshold);
            if (own.fit.hasJnd)
                jnds.push_back(f.jnd());
            else
                warnOf(report, condition.name, own.participant,
                       ": thresholds from " + shownCell(plainNumber(own.fit.steps.first)) + " to " +
                           shownCell(plainNumber(own.fit.steps.second)) +
                           " fit as well, of functions as steep as one likes: no " + words.slope(o.model) +
                           "; " + words.half(o.model) + ": the middle");
            table.row(condition.name, own.participant, own.trials, f.threshold,
                      onlyIf(own.fit.hasJnd, f.width), onlyIf(own.fit.hasJnd, f.jnd()), f.guess, f.lapse,
                      own.fit.logLikelihood);
        }
        if (thresholds.empty()) continue;
        isFitted = true;
        summarise(summary, condition.name, words.half(o.model), thresholds);
        summarise(summary, condition.name, words.slope(o.model), jnds, true);
    }
    if (!isFitted) return tellNobodyFitted(to);
    report.summary = summary.text();
    const auto& first = data.conditions.front();
    report.picture = [first, model = o.model, words, frame = frameOf(o, first.name, report.isSimulated)] {
        return psychometricChart(frame, first.trials, model, words);
    };
}

void analysePowerLaw(const LevelAnswers& data, const Findings& to) {
    auto& [o, report, out, table] = to;
    ExportTable summary{"power-law", data.isSimulated, summaryColumns};
    for (const auto& condition : data.conditions) {
        std::vector<double> exponents;
        for (const auto& own : powerLawByParticipant(condition.trials)) {
            if (!own.fit.fault.empty()) {
                warnOf(report, condition.name, own.participant, " left out: " + own.fit.fault);
                continue;
            }
            exponents.push_back(own.fit.exponent);
            table.row(condition.name, own.participant, own.trials, own.fit.exponent, own.fit.factor,
                      own.fit.determination);
        }
        if (exponents.empty()) return tellNobodyFitted(to);
        summarise(summary, condition.name, "exponent", exponents);
    }
    report.summary = summary.text();
    const auto& first = data.conditions.front();
    report.picture = [first, level = o.level.empty() ? std::string("level") : o.level,
                      frame = frameOf(o, first.name, report.isSimulated)] {
        return powerLawChart(frame, first.trials, level);
    };
}

} // namespace physvib
