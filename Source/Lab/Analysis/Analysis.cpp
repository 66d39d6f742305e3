// SPDX-License-Identifier: MIT
// List of all analyses, and selection of those that fit a table.
#include "Lab/Analysis/Analysis.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/ReportTrials.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

namespace physvib {

std::string shownCell(const std::string& cell) {
    const auto number = parseNumber<double>(cell);
    if (!number || cell.find_first_of(".e") == std::string::npos) return cell;
    if (std::abs(*number) >= 1000.0) return fixedNumber(*number, 1);
    char digits[32];
    return {digits,
            std::to_chars(digits, digits + sizeof digits, *number, std::chars_format::general, 4).ptr};
}

namespace {

template <auto reader>
auto fromFiles(const AnalysisJob& job) {
    return readStudyFiles(job, reader);
}

} // namespace

Result<StudyData<LevelTrial>> readFinishedLevels(const AnalysisJob& job) {
    return readStudyFiles(job, [&job](const std::vector<NamedText>& files) {
        auto data = readLevels(files);
        for (const NamedText& file : files) {
            const auto trials =
                readReportTrials({{std::string{file.name}, std::string{file.text}}}, {}, job.protocol);
            if (!data || !trials) continue;
            if (job.made == nullptr && !trials.value.protocol && hasAdaptiveRows(trials.value))
                data.value.warnings.push_back(
                    std::string{file.name} + ": of no built-in protocol: unfinished staircases are not known "
                                             "(physvib report --protocol)");
            const auto isOf = [](const LevelTrial& trial, const std::string& session) {
                return trial.session.substr(0, trial.session.find('/')) == session;
            };
            auto& levels = data.value.conditions.front().trials;
            for (const SessionPlan& plan : trials.value.sessions())
                for (LevelTrial& trial : levels)
                    if (plan.staircase && isOf(trial, plan.name))
                        trial.range = {plan.staircase->leastDb, plan.staircase->mostDb};
            for (const UnfinishedRun& run : unfinishedRuns(trials.value))
                if (run.isAdaptive && !run.isOver &&
                    std::erase_if(levels,
                                  [&](const LevelTrial& trial) {
                                      return trial.participant == run.participant &&
                                             (trial.condition == run.condition ||
                                              trial.condition == inSession(run.condition, run.session)) &&
                                             isOf(trial, run.session);
                                  }) > 0 &&
                    job.made == nullptr) // a report has told them
                    data.value.warnings.push_back("participant " + run.participant + " left out: " +
                                                  inSession(run.session, run.condition) + ": " + run.why());
        }
        return data;
    });
}

namespace {

/// A table in columns of spaces.
std::string aligned(const std::string& csv) {
    const CsvTable table = readCsvTable(csv, "").value;
    if (table.columns.empty()) return {};
    std::vector<std::vector<std::string>> rows{table.columns};
    for (const CsvRow& row : table.rows) {
        auto& cells = rows.emplace_back();
        for (const std::string& cell : row.cells) cells.push_back(cleanLine(shownCell(cell)));
    }
    std::vector<std::size_t> widths(table.columns.size(), 0);
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    std::string text;
    for (const auto& row : rows) {
        for (std::size_t c = 0; c < row.size(); ++c)
            text += row[c] + std::string(widths[c] - row[c].size() + 2, ' ');
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    }
    return text;
}

/// What `analyse` finds in the trials that `read` finds.
template <auto read, auto analyse>
AnalysisReport analysed(const Analysis& which, const AnalysisJob& job) {
    const auto data = read(job);
    if (!data) return {data.error};
    AnalysisReport report{{}, data.value.isSimulated, data.value.warnings};
    ExportTable table{which.name, report.isSimulated, which.columns};
    std::ostringstream out;
    analyse(data.value, Findings{job, report, out, table});
    report.table = table.text();
    if (report.summary.empty()) report.summary = report.table;
    report.words = out.str().empty() ? aligned(report.summary) : out.str();
    return report;
}

constexpr Analysis analyses[] = {
    {"confusion", "stimulus,response per trial: percent correct and information transfer",
     "condition,participant,stimulus,response,count", analysed<readLabels, analyseConfusion>},
    {"resolution", "pointing responses: normals, likelihood map, percent counts, perceptual resolution",
     "condition,target_column,target_row,responses,mean_x,mean_y,variance_x,variance_y,covariance,percent,"
     "borrowed",
     analysed<fromFiles<readLocations>, analyseResolution>},
    {"places", "pointing at targets anywhere: constant and variable error, distance, gain",
     "condition,participant,target,trials,true_x,true_y,constant_x,constant_y,variable,distance",
     analysed<readTargets, analysePlaces>},
    {"percent-counts", "percent counts: the largest grid that merging makes of them",
     "condition,row,column,percent", analysed<fromFiles<readPercentCounts>, analysePercentCounts>},
    {"choices", "forced choices: shares of the alternatives",
     "condition,alternative,votes,trials,participants,percent,participants_median_percent,least_percent,"
     "most_percent,interval",
     analysed<fromFiles<readChoices>, analyseChoices>},
    {"ratings", "slider ratings: means by condition",
     "condition,scale,trials,participants,mean,median,standard_deviation,half_interval",
     analysed<fromFiles<readRatings>, analyseRatings>},
    {"levels", "staircases, QUEST+, adjustments and magnitude estimations: thresholds and means",
     "kind,condition,stimulus,trials,participants,estimate,standard_deviation,half_interval",
     analysed<readFinishedLevels, analyseLevels>},
    {"icons", "stimulus,response per trial: the patterns that are confused least",
     "condition,stimulus,percent_correct", analysed<readLabels, analyseIcons>},
    {"psychometric", "psychometric functions of each participant, thresholds and JNDs over participants",
     "condition,participant,trials,threshold,width,jnd,guess,lapse,log_likelihood",
     analysed<readAnswers, analysePsychometric>, Analysis::Kind::fit},
    {"power-law", "Stevens' exponent of magnitude estimations",
     "condition,participant,trials,exponent,factor,r_squared", analysed<readMagnitudes, analysePowerLaw>,
     Analysis::Kind::fit},
};

} // namespace

std::span<const Analysis> allAnalyses() noexcept { return analyses; }

std::vector<std::string> analysesFor(const CsvTable& table) {
    std::set<std::string> found;
    const auto has = [&](std::string_view column) { return table.column(column).has_value(); };
    if (const auto task = table.column(trialColumns::task)) {
        const auto phase = table.column(trialColumns::phase), correct = table.column("correct"),
                   level = table.column("level_db"), ranOut = table.column(trialColumns::ranOut);
        for (const CsvRow& row : table.rows) {
            const StudyTaskDescription* const did = studyTaskNamed(row.cells[*task]);
            if (did == nullptr || (ranOut && row.cells[*ranOut] == "1")) continue;
            const bool isTraining = phase && row.cells[*phase] == trialColumns::training;
            const bool isAdapted = did->answer == AnswerKind::choice && correct &&
                                   !row.cells[*correct].empty() && !(level && row.cells[*level].empty());
            if (did->answer == AnswerKind::level || (isAdapted && !isTraining))
                found.insert("levels"); // matches before a study stand for themselves
            else if (!isTraining && !isAdapted)
                found.emplace(did->analysis);
        }
    } else {
        if (has("stimulus") && has("response")) found.insert("confusion");
        const bool isGrid = has("target_column") && (has("target_row") || !has("target_x"));
        if (isGrid && has("x"))
            found.insert("resolution");
        else if (has("target_x") && has("x"))
            found.insert("places");
        if (has("c1")) found.insert("percent-counts");
        if (has("choice")) found.insert("choices");
        if (has("value") || (has("level_db") && has("correct"))) found.insert("levels");
        const bool hasScale =
            std::ranges::any_of(table.columns, [](const auto& column) { return !trialColumns::has(column); });
        if (found.empty() && has("participant") && (has("stimulus") || has("condition") || has("group")) &&
            hasScale)
            found.insert("ratings");
    }
    std::vector<std::string> names;
    for (const Analysis& analysis : analyses)
        if (found.contains(std::string{analysis.name})) names.emplace_back(analysis.name);
    return names;
}

namespace {

/// Of a table that an analysis rejected, the call that reads its trials; empty if that is unknown, or the
/// kind was right and the error is another.
std::string otherKindWords(const Analysis& asked, const AnalysisJob& job) {
    if (job.files.empty() || job.made != nullptr) return {};
    std::vector<std::string> names;
    bool hasPlaces = false, isOwn = false;
    const auto look = [&](const std::vector<NamedText>& files) -> Result<bool> {
        RowsLeftOut leftOut;
        const auto table = readStudyTable(files[0].text, files[0].name, job.columns, leftOut);
        if (table) names = analysesFor(table.value);
        hasPlaces = table.value.column("target_x").has_value();
        isOwn = table.value.column(trialColumns::task).has_value();
        return true;
    };
    readStudyFiles(job, look);
    std::string words;
    for (const std::string& name : names) {
        if (name == asked.name || (asked.kind == Analysis::Kind::fit && name == "levels" && !isOwn) ||
            (asked.name == "icons" && name == "confusion") ||
            (asked.name == "places" && name == "resolution" && hasPlaces))
            return {};
        words +=
            (words.empty() ? "; the file has trials that `physvib analyse " : ", `analyse ") + name + "`";
    }
    return words.empty() ? words : words + " reads";
}

} // namespace

AnalysisReport analyse(const std::string& name, const AnalysisJob& job) {
    const auto found = std::ranges::find(analyses, name, &Analysis::name);
    if (found == std::end(analyses)) return AnalysisReport{"no analysis " + inQuotes(name)};
    AnalysisReport report = found->run(*found, job);
    if (!report.error.empty()) report.error += otherKindWords(*found, job);
    return report;
}

} // namespace physvib
