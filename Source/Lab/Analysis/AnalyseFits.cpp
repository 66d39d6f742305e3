// SPDX-License-Identifier: MIT
// Analyses psychometric and power-law: one fit per participant, and means with intervals per condition.
#include "Lab/Analysis/Analyses.h"
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Analysis/FitCharts.h"
#include "Lab/Statistics/LevelFits.h"
#include "Lab/Statistics/Moments.h"
#include <algorithm>
#include <sstream>

namespace physvib {
namespace {

using LevelAnswers = StudyData<LevelAnswer>;

Result<LevelAnswers> readAnswers(const AnalysisJob& o, LevelAnswerColumns columns) {
    if (!o.level.empty()) columns.level = o.level;
    if (!o.measure.empty()) columns.measure = o.measure;
    return readStudyFiles(
        o, [&](const std::vector<NamedText>& files) { return readLevelAnswers(files, columns); });
}

/// "threshold 12.3 (11.0 to 13.4)".
std::string meanWords(const char* name, const std::vector<double>& values, int decimals) {
    const Moments own{values};
    std::string words = std::string(name) + " " + fixedNumber(own.mean, decimals);
    if (own.n > 1)
        words += " (" + fixedNumber(own.least(), decimals) + " to " + fixedNumber(own.most(), decimals) + ")";
    return words;
}

std::string prefixOf(const std::string& condition) {
    return condition.empty() ? "" : printable(condition) + ": ";
}

void leaveOut(AnalysisReport& report, const std::string& condition, const std::string& participant,
              const std::string& fault) {
    report.warnings.push_back(prefixOf(condition) + "participant " + printable(participant) +
                              " left out: " + fault);
}

/// Error line if no participant could be fitted.
AnalysisReport nobodyFitted(const AnalysisJob& o, const AnalysisReport& report) {
    return {o.files.front() + ": nobody can be fitted; " + report.warnings.back()};
}

/// Chart of the first condition; reports have charts of all.
ChartFrame frameOf(const AnalysisJob& o, const std::string& condition, bool isSimulated) {
    return {"fit", condition.empty() ? std::filesystem::path{o.files.front()}.filename().string() : condition,
            isSimulated};
}

/// Warning for a threshold outside the participant's levels; empty if it lies between them.
std::string beyondWords(const std::vector<LevelAnswer>& trials, const std::string& participant,
                        const PsychometricFunction& f) {
    const double threshold = f.threshold;
    double least = threshold, most = threshold;
    bool isFirst = true;
    for (const LevelAnswer& trial : trials) {
        if (trial.participant != participant) continue;
        least = isFirst ? trial.level : std::min(least, trial.level);
        most = isFirst ? trial.level : std::max(most, trial.level);
        isFirst = false;
    }
    if (threshold >= least && threshold <= most) return {};
    return "participant " + printable(participant) + ": the threshold, " +
           fixedNumber(threshold, decimalsOf(f.jnd())) + ", lies outside the levels that were played, " +
           plainNumber(least) + " to " + plainNumber(most);
}

} // namespace

AnalysisReport analysePsychometric(const AnalysisJob& o) {
    const auto data = readAnswers(o, {"level_db", "correct", false});
    if (!data) return {data.error};
    AnalysisReport report{{}, data.value.isSimulated, data.value.warnings};
    std::ostringstream out;
    ExportTable table{"psychometric", report.isSimulated,
                      "condition,participant,trials,threshold,width,jnd,guess,lapse,log_likelihood"};
    for (const auto& condition : data.value.conditions) {
        std::vector<double> thresholds, jnds;
        const bool isAdaptive = condition.trials.front().isAdaptive;
        const auto ifKnown = [=](double slope) { return isAdaptive ? std::nullopt : std::optional{slope}; };
        for (const auto& own : psychometricByParticipant(condition.trials, o.model)) {
            if (!own.fit.fault.empty()) {
                leaveOut(report, condition.name, own.participant, own.fit.fault);
                continue;
            }
            const PsychometricFunction& f = own.fit.function;
            if (std::string words = beyondWords(condition.trials, own.participant, f); !words.empty())
                report.warnings.push_back(prefixOf(condition.name) + words);
            thresholds.push_back(f.threshold);
            jnds.push_back(f.jnd());
            table.row(condition.name, own.participant, own.trials, f.threshold, ifKnown(f.width),
                      ifKnown(f.jnd()), f.guess, f.lapse, own.fit.logLikelihood);
        }
        if (thresholds.empty()) return nobodyFitted(o, report);
        const int decimals = decimalsOf(Moments(jnds).mean);
        out << prefixOf(condition.name) << meanWords("threshold", thresholds, decimals) << ", "
            << (isAdaptive ? "no JND (answers chose the levels, which makes slopes too steep)"
                           : meanWords("JND", jnds, decimals))
            << ", " << counted(thresholds.size(), "participant") << '\n';
    }
    report.words = out.str();
    report.table = table.text();
    const auto first = data.value.conditions.front();
    report.picture = [first, model = o.model, words = fitWords(o.columns, o.level, o.measure),
                      frame = frameOf(o, first.name, report.isSimulated)] {
        return psychometricChart(frame, first.trials, model, words);
    };
    return report;
}

AnalysisReport analysePowerLaw(const AnalysisJob& o) {
    const auto data = readAnswers(o, {"stimulus", "value", true});
    if (!data) return {data.error};
    AnalysisReport report{{}, data.value.isSimulated, data.value.warnings};
    std::ostringstream out;
    ExportTable table{"power-law", report.isSimulated,
                      "condition,participant,trials,exponent,factor,r_squared"};
    for (const auto& condition : data.value.conditions) {
        std::vector<double> exponents;
        for (const auto& own : powerLawByParticipant(condition.trials)) {
            if (!own.law.fault.empty()) {
                leaveOut(report, condition.name, own.participant, own.law.fault);
                continue;
            }
            exponents.push_back(own.law.exponent);
            table.row(condition.name, own.participant, own.trials, own.law.exponent, own.law.factor,
                      own.law.determination);
        }
        if (exponents.empty()) return nobodyFitted(o, report);
        out << prefixOf(condition.name) << meanWords("exponent", exponents, 3) << ", "
            << counted(exponents.size(), "participant") << '\n';
    }
    report.words = out.str();
    report.table = table.text();
    const auto first = data.value.conditions.front();
    report.picture = [first, level = o.level.empty() ? std::string("level") : o.level,
                      frame = frameOf(o, first.name, report.isSimulated)] {
        return powerLawChart(frame, first.trials, level);
    };
    return report;
}

} // namespace physvib
