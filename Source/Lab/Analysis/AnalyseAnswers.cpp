// SPDX-License-Identifier: MIT
// Analyses of choices, ratings and levels, and of functions fitted to them, as text and tables.
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Study/Psychometric.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace physvib {
namespace {

void tell(std::ostream& out, const ChoiceSummary& summary) {
    out << cleanLine(summary.condition) << ':';
    for (const ChoiceShare& share : summary.shares)
        out << (&share == &summary.shares.front() ? " " : ", ") << cleanLine(share.alternative) << ' '
            << percent(share.share) << " % ("
            << (share.hasInterval() ? percent(share.least) + " to " + percent(share.most) : "of each") << ')';
    out << ", " << counted(summary.trials, "trial") << " of " << counted(summary.participants, "participant");
    out << '\n';
}

const char* kindWord(LevelTrial::Kind kind) {
    if (kind == LevelTrial::Kind::staircase) return "threshold";
    if (kind == LevelTrial::Kind::quest) return "threshold by QUEST+";
    return kind == LevelTrial::Kind::adjustment ? "matched at" : "magnitude";
}

/// "60, beside 200 at 0 dB, set to", of levels that were set in a session of a known protocol.
std::string kindWords(const LevelSummary& s, const std::optional<Protocol>& protocol) {
    std::set<std::string> all;
    if (protocol && s.kind == LevelTrial::Kind::adjustment)
        for (const SessionPlan& one : protocol->sessions) {
            if (!one.adjustment) continue;
            std::string words = one.adjustment->alternative;
            for (const Alternative& other : one.alternatives)
                if (other.name != one.adjustment->alternative)
                    words += ", beside " + other.name + " at " + numberText(other.levelDb) + " dB";
            words += ", set to";
            if (s.condition.ends_with(" in " + one.name)) return words;
            all.insert(words);
        }
    return all.size() == 1 ? *all.begin() : kindWord(s.kind);
}

void tell(std::ostream& out, const LevelSummary& s, const std::optional<Protocol>& protocol) {
    const bool isMagnitude = s.kind == LevelTrial::Kind::magnitude;
    const std::string stimulus = protocol && s.stimulus == "stimulus" ? "" : s.stimulus; // the only one
    out << cleanLine(s.condition) << (stimulus.empty() || s.condition.empty() ? "" : ", ")
        << cleanLine(stimulus) << ": " << (isMagnitude ? "geometric mean " : "")
        << cleanLine(kindWords(s, protocol)) << ' ';
    const bool isThreshold = s.kind == LevelTrial::Kind::staircase || s.kind == LevelTrial::Kind::quest;
    if (isThreshold && s.thresholds.empty()) {
        out << "of nobody, " << counted(s.trials, "trial") << '\n';
        return;
    }
    out << fixedNumber(s.estimate, isMagnitude ? 2 : 1) << (isMagnitude ? "" : " dB");
    if (s.deviation > 0.0)
        out << " (standard deviation " << fixedNumber(s.deviation, 2) << (isMagnitude ? " of log10" : " dB")
            << (s.participants > 1 ? " over participants)" : " over trials)");
    if (s.halfInterval > 0.0)
        out << ", 95 % interval " << fixedNumber(s.estimate - s.halfInterval, 1) << " to "
            << fixedNumber(s.estimate + s.halfInterval, 1) << " dB"
            << (s.participants > 1 ? " over participants"
                                   : " (1.96 standard deviations of what is still possible)");
    out << ", " << counted(s.trials, "trial") << " of "
        << counted(isThreshold ? s.thresholds.size() : s.participants, "participant");
    if (s.kind == LevelTrial::Kind::staircase)
        out << ", " << s.reversals << " reversals of the level that a trial followed";
    out << '\n';
}

} // namespace

void analyseChoices(const StudyData<ChoiceTrial>& data, const Findings& to) {
    auto& [job, report, out, table] = to;
    const auto summaries = bySession(data, summariseChoices);
    if (summaries.front().participants == 1)
        report.warnings.push_back("one participant, or no column participant: intervals are over trials, and "
                                  "say nothing about other people");
    for (const auto& summary : summaries) {
        tell(out, summary);
        for (const auto& share : summary.shares)
            table.row(summary.condition, share.alternative, std::size_t{share.hits},
                      std::size_t{share.trials}, 100.0 * share.share,
                      share.hasInterval() ? std::optional{100.0 * share.least} : std::nullopt,
                      share.hasInterval() ? std::optional{100.0 * share.most} : std::nullopt,
                      share.participants, 100.0 * share.median);
    }
    out << "(... to ...): 95 % interval over "
        << (summaries.front().participants > 1 ? "participants" + intervalNotes(summaries) + "\n"
                                               : "trials, of one participant\n")
        << "shares over several conditions are of all trials that each participant had in them\n";
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
    const auto summaries = bySession(data, summariseRatings);
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
                                  counted(count, "trial") + " without a score of " + cleanLine(where[2]) +
                                  ", left out of its means and tests");
    std::set<bool> intervals; // true: over participants
    for (const auto& summary : summaries) {
        if (std::ranges::any_of(summary.halfIntervals, [](double half) { return half > 0.0; }))
            intervals.insert(summary.participants > 1);
        out << cleanLine(summary.condition) << ": " << counted(summary.trials, "trial") << " of "
            << counted(summary.participants, "participant");
        for (std::size_t s = 0; s < scales.size(); ++s) {
            if (std::isnan(summary.means[s])) continue;
            out << ", " << cleanLine(scales[s]) << ' ' << fixedNumber(summary.means[s], 1);
            if (summary.halfIntervals[s] > 0.0) out << " +- " << fixedNumber(summary.halfIntervals[s], 1);
            if (summary.scored[s] < summary.trials)
                out << " (of " << counted(summary.scored[s], "trial") << " of "
                    << counted(summary.raters[s], "participant") << ')';
            const auto known = [&](double spread) { // of one score there is none
                return summary.scored[s] > 1 ? std::optional{spread} : std::nullopt;
            };
            const bool isAlone = summary.raters[s] < 2 && summary.halfIntervals[s] == 0.0;
            table.row(summary.condition, scales[s], summary.scored[s], summary.raters[s], summary.means[s],
                      known(summary.deviations[s]), isAlone ? std::nullopt : known(summary.halfIntervals[s]));
        }
        out << '\n';
    }
    if (!intervals.empty())
        out << "+-: half of the 95 % interval over "
            << (intervals.contains(true) ? "participants" : "trials, of one participant") << '\n';
    std::set<std::string> conditions;
    for (const auto& session : data.conditions)
        for (const RatingTrial& trial : session.trials)
            conditions.insert(inSession(trial.condition, session.name));
    std::set<std::string> without;
    for (const auto& session : data.conditions)
        for (std::size_t s = 0; s < scales.size(); ++s) without.merge(peopleLackingCells(session.trials, s));
    if (summaries.size() > conditions.size())
        out << "of a factor's level a participant has the mean of their means of the conditions whose names "
               "have it"
            << (without.empty() ? "" : ", without who lacks one: " + joined(without, ", ")) << '\n';
    report.picture = [scales, summaries, isSimulated = data.isSimulated] {
        return scoresChart({chartName(0), "Mean scores", isSimulated}, scales, summaries);
    };
}

void analyseLevels(const StudyData<LevelTrial>& data, const Findings& to) {
    auto& [job, report, out, table] = to;
    const auto summaries = summariseLevels(data.conditions.front().trials);
    ExportTable each{"thresholds", data.isSimulated, "method,condition,participant,threshold"};
    for (const LevelSummary& s : summaries) {
        tell(out, s, job.protocol);
        for (const std::string& words : s.leftOut)
            report.warnings.push_back(cleanLine(s.condition) + ": " + words);
        for (const auto& [participant, threshold] : s.thresholds)
            each.row(s.kind == LevelTrial::Kind::quest ? "quest" : "staircase", s.condition, participant,
                     threshold);
        const auto known = [&s](double spread) { // of one value there is none
            return s.participants > 1 || spread > 0.0 ? std::optional{spread} : std::nullopt;
        };
        table.row(kindWord(s.kind), s.condition, s.stimulus, s.trials, s.participants, s.reversals,
                  s.estimate, known(s.deviation), known(s.halfInterval));
    }
    if (std::ranges::any_of(summaries, [](const auto& s) { return s.reversals > 0; }))
        out << staircaseThresholds << '\n';
    if (std::ranges::any_of(
            summaries, [](const auto& s) { return s.kind == LevelTrial::Kind::quest && s.participants > 1; }))
        out << questThresholds << '\n';
    report.participants = each.text();
    report.picture = [summaries, isSimulated = data.isSimulated] {
        using Kind = LevelTrial::Kind;
        std::vector<std::string> charts;
        for (const auto& [kind, title] :
             {std::pair{Kind::staircase, "Thresholds, mean of the later reversals"},
              {Kind::adjustment, "Matched levels"},
              {Kind::magnitude, "Magnitudes"},
              {Kind::quest, "Thresholds by QUEST+"}})
            charts.push_back(levelChart({chartName(charts.size()), title, isSimulated}, summaries, kind));
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

/// "threshold 12.3 (95 % interval 11.0 to 13.4)", over participants. Of what is above 0, no interval goes
/// below.
std::string meanWords(const char* name, const std::vector<double>& values, int decimals,
                      bool isAboveZero = false) {
    const Moments own{values};
    std::string words = std::string(name) + " " + fixedNumber(own.mean, decimals);
    if (own.n > 1 && isAboveZero && own.least() <= 0.0)
        words += " (standard deviation " + fixedNumber(own.deviation, decimals) +
                 "; no interval: Student's would reach below 0)";
    else if (own.n > 1)
        words += " (95 % interval " + fixedNumber(own.least(), decimals) + " to " +
                 fixedNumber(own.most(), decimals) + ")";
    return words;
}

std::string prefixOf(const std::string& condition) {
    return condition.empty() ? "" : cleanLine(condition) + ": ";
}

void warnOf(AnalysisReport& report, const std::string& condition, const std::string& participant,
            const std::string& words) {
    report.warnings.push_back(prefixOf(condition) + "participant " + cleanLine(participant) + words);
}

/// Four standard errors below what guessing gives.
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
    const auto stepWords = [](const std::pair<double, double>& steps) {
        const int decimals = decimalsOf(steps.first);
        return "the middle of those that fit as well, between " + fixedNumber(steps.first, decimals) +
               " and " + fixedNumber(steps.second, decimals);
    };
    for (const auto& condition : data.conditions) {
        std::vector<double> thresholds, jnds;
        for (const LevelCount& at :
             countByLevel(condition.trials, [](const LevelAnswer& one) { return one.counted(); }))
            if (isBelowGuess(at, o.model.guess)) {
                report.warnings.push_back(prefixOf(condition.name) + "answers at " + plainNumber(at.level) +
                                          " lie far below the guess rate of " + percent(o.model.guess) +
                                          " %: of yes or no, stronger or weaker, it is 0 (--guess 0)");
                break;
            }
        for (const auto& own : psychometricByParticipant(condition.trials, o.model)) {
            if (!own.fit.fault.empty()) {
                warnOf(report, condition.name, own.participant, " left out: " + own.fit.fault);
                continue;
            }
            const PsychometricFunction& f = own.fit.function;
            const auto ifKnown = [&](double slope) {
                return own.fit.hasJnd ? std::optional{slope} : std::nullopt;
            };
            thresholds.push_back(f.threshold);
            if (own.fit.hasJnd)
                jnds.push_back(f.jnd());
            else
                warnOf(
                    report, condition.name, own.participant,
                    ": a step fits as well, so the answers tell no JND; the mean JND lacks it, which may be "
                    "the smallest; the " +
                        std::string{words.half(o.model)} + " that counts is " + stepWords(own.fit.steps));
            table.row(condition.name, own.participant, own.trials, f.threshold, ifKnown(f.width),
                      ifKnown(f.jnd()), f.guess, f.lapse, own.fit.logLikelihood);
        }
        if (thresholds.empty()) continue;
        isFitted = true;
        const int decimals = decimalsOf(Moments(jnds.empty() ? thresholds : jnds).mean);
        out << prefixOf(condition.name) << meanWords(words.half(o.model), thresholds, decimals) << ", "
            << (jnds.empty() ? "no JND (a step fits as well)" : meanWords("JND", jnds, decimals, true))
            << (!jnds.empty() && jnds.size() < thresholds.size()
                    ? " (n = " + std::to_string(jnds.size()) + ")"
                    : "")
            << ", in " << cleanLine(words.unit()) << ", " << counted(thresholds.size(), "participant")
            << '\n';
    }
    if (!isFitted) return tellNobodyFitted(to);
    const auto& first = data.conditions.front();
    report.picture = [first, model = o.model, words, frame = frameOf(o, first.name, report.isSimulated)] {
        return psychometricChart(frame, first.trials, model, words);
    };
}

void analysePowerLaw(const LevelAnswers& data, const Findings& to) {
    auto& [o, report, out, table] = to;
    for (const auto& condition : data.conditions) {
        std::vector<double> exponents;
        for (const auto& own : powerLawByParticipant(condition.trials)) {
            if (!own.law.fault.empty()) {
                warnOf(report, condition.name, own.participant, " left out: " + own.law.fault);
                continue;
            }
            exponents.push_back(own.law.exponent);
            table.row(condition.name, own.participant, own.trials, own.law.exponent, own.law.factor,
                      own.law.determination);
        }
        if (exponents.empty()) return tellNobodyFitted(to);
        out << prefixOf(condition.name) << meanWords("exponent", exponents, 3) << ", "
            << counted(exponents.size(), "participant") << '\n';
    }
    const auto& first = data.conditions.front();
    report.picture = [first, level = o.level.empty() ? std::string("level") : o.level,
                      frame = frameOf(o, first.name, report.isSimulated)] {
        return powerLawChart(frame, first.trials, level);
    };
}

} // namespace physvib
