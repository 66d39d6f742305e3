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

std::string displayCell(const std::string& cell) {
    const auto number = parseNumber<double>(cell);
    if (!number || cell.find_first_of(".e") == std::string::npos) return cell;
    if (std::abs(*number) >= 1000.0) return fixedNumber(*number, 1);
    char digits[32];
    return {digits,
            std::to_chars(digits, digits + sizeof digits, *number, std::chars_format::general, 4).ptr};
}

namespace {

template <auto reader>
auto readFiles(const AnalysisJob& job) {
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
            if (job.memoryTables == nullptr && !trials.value.protocol && hasAdaptiveRows(trials.value))
                data.value.warnings.push_back(
                    std::string{file.name} + ": of no built-in protocol: unfinished staircases are not known "
                                             "(physvib report --protocol)");
            const auto isOfSession = [](const LevelTrial& trial, const std::string& session) {
                return trial.session == session ||
                       trial.session.substr(0, trial.session.rfind('/')) == session;
            };
            auto& levels = data.value.groups.front().trials;
            for (const SessionPlan& plan : trials.value.sessions())
                for (LevelTrial& trial : levels)
                    if (plan.staircase && isOfSession(trial, plan.name))
                        trial.range = {plan.staircase->minDb, plan.staircase->maxDb};
            for (const UnfinishedRun& run : unfinishedRuns(trials.value))
                if (run.isAdaptive && !run.isComplete &&
                    std::erase_if(levels,
                                  [&](const LevelTrial& trial) {
                                      return trial.participant == run.participant &&
                                             (trial.condition == run.condition ||
                                              trial.condition == nameInSession(run.condition, run.session)) &&
                                             isOfSession(trial, run.session);
                                  }) > 0 &&
                    job.memoryTables == nullptr) // a report lists them itself
                    data.value.warnings.push_back("participant " + run.participant +
                                                  " left out: " + nameInSession(run.session, run.condition) +
                                                  ": " + run.reason());
        }
        return data;
    });
}

namespace {

/// A table in columns of spaces.
std::string alignColumns(const std::string& csv) {
    const CsvTable table = readCsvTable(csv, "").value;
    if (table.columns.empty()) return {};
    std::vector<std::vector<std::string>> rows{table.columns};
    for (const CsvRow& row : table.rows) {
        auto& cells = rows.emplace_back();
        for (const std::string& cell : row.cells) cells.push_back(cleanLine(displayCell(cell)));
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

/// Report of `analyse` on the trials that `read` returns; its error if it fails.
template <auto read, auto analyse>
AnalysisReport runAnalysis(const Analysis& entry, const AnalysisJob& job) {
    const auto data = read(job);
    if (!data) return {data.error};
    AnalysisReport report{{}, data.value.isSimulated, data.value.warnings};
    ExportTable table{entry.name, report.isSimulated, entry.columns};
    std::ostringstream out;
    analyse(data.value, AnalysisOutput{job, report, out, table});
    report.table = table.text();
    if (report.summary.empty()) report.summary = report.table;
    report.text = out.str().empty() ? alignColumns(report.summary) : out.str();
    return report;
}

constexpr Analysis analyses[] = {
    {"confusion", "stimulus,response per trial: percent correct and information transfer",
     "condition,participant,stimulus,response,count", runAnalysis<readLabels, analyseConfusion>},
    {"resolution", "pointing responses: normals, likelihood map, percent counts, perceptual resolution",
     "condition,target_column,target_row,responses,mean_x,mean_y,variance_x,variance_y,covariance,percent,"
     "borrowed",
     runAnalysis<readFiles<readLocations>, analyseResolution>},
    {"places", "pointing at targets anywhere: constant and variable error, distance, gain",
     "condition,participant,target,trials,true_x,true_y,constant_x,constant_y,variable,distance",
     runAnalysis<readTargets, analysePlaces>},
    {"percent-counts", "percent counts: the largest grid that merging makes of them",
     "condition,row,column,percent", runAnalysis<readFiles<readPercentCounts>, analysePercentCounts>},
    {"choices", "forced choices: shares of the alternatives",
     "condition,alternative,votes,trials,participants,percent,participants_median_percent,least_percent,"
     "most_percent,interval",
     runAnalysis<readFiles<readChoices>, analyseChoices>},
    {"ratings", "slider ratings: means by condition",
     "condition,scale,trials,participants,mean,median,standard_deviation,half_interval",
     runAnalysis<readFiles<readRatings>, analyseRatings>},
    {"levels", "staircases, QUEST+, adjustments and magnitude estimations: thresholds and means",
     "kind,condition,stimulus,trials,participants,estimate,standard_deviation,half_interval",
     runAnalysis<readFinishedLevels, analyseLevels>},
    {"icons", "stimulus,response per trial: the patterns that are confused least",
     "condition,stimulus,percent_correct", runAnalysis<readLabels, analyseIcons>},
    {"psychometric", "psychometric functions of each participant, thresholds and JNDs over participants",
     "condition,participant,trials,threshold,width,jnd,guess,lapse,log_likelihood",
     runAnalysis<readAnswers, analysePsychometric>, Analysis::Kind::fit},
    {"power-law", "Stevens' exponent of magnitude estimations",
     "condition,participant,trials,exponent,factor,r_squared", runAnalysis<readMagnitudes, analysePowerLaw>,
     Analysis::Kind::fit},
};

} // namespace

std::span<const Analysis> allAnalyses() noexcept { return analyses; }

std::vector<std::string> analysesFor(const CsvTable& table) {
    std::set<std::string> found;
    const auto hasColumn = [&](std::string_view column) { return table.column(column).has_value(); };
    if (const auto task = table.column(trialColumns::task)) {
        const auto phase = table.column(trialColumns::phase), correct = table.column("correct"),
                   level = table.column("level_db"), timedOut = table.column(trialColumns::timedOut);
        for (const CsvRow& row : table.rows) {
            const StudyTaskDescription* const rowTask = findStudyTask(row.cells[*task]);
            if (rowTask == nullptr || (timedOut && row.cells[*timedOut] == "1")) continue;
            const bool isTraining = phase && row.cells[*phase] == trialColumns::training;
            const bool isAdapted = rowTask->answer == AnswerKind::choice && correct &&
                                   !row.cells[*correct].empty() && !(level && row.cells[*level].empty());
            if (rowTask->answer == AnswerKind::level || (isAdapted && !isTraining))
                found.insert("levels"); // levels that are set in trainings count too
            else if (!isTraining && !isAdapted)
                found.emplace(rowTask->analysis);
        }
    } else {
        if (hasColumn("stimulus") && hasColumn("response")) found.insert("confusion");
        const bool isGrid = hasColumn("target_column") && (hasColumn("target_row") || !hasColumn("target_x"));
        if (isGrid && hasColumn("x"))
            found.insert("resolution");
        else if (hasColumn("target_x") && hasColumn("x"))
            found.insert("places");
        if (hasColumn("c1")) found.insert("percent-counts");
        if (hasColumn("choice")) found.insert("choices");
        if (hasColumn("value") || (hasColumn("level_db") && hasColumn("correct"))) found.insert("levels");
        const bool hasScale =
            std::ranges::any_of(table.columns, [](const auto& column) { return !trialColumns::has(column); });
        if (found.empty() && hasColumn("participant") &&
            (hasColumn("stimulus") || hasColumn("condition") || hasColumn("group")) && hasScale)
            found.insert("ratings");
    }
    std::vector<std::string> names;
    for (const Analysis& analysis : analyses)
        if (found.contains(std::string{analysis.name})) names.emplace_back(analysis.name);
    return names;
}

namespace {

/// Text on the calls that read the trials of a table that `requested` rejected. Empty if there are none, or
/// if the analysis fits the trials and failed for another reason.
std::string otherKindText(const Analysis& requested, const AnalysisJob& job) {
    if (job.files.empty() || job.memoryTables != nullptr) return {};
    std::vector<std::string> names;
    bool hasPlaces = false, hasTasks = false;
    const auto inspect = [&](const std::vector<NamedText>& files) -> Result<bool> {
        ExcludedRows excluded;
        const auto table = readStudyTable(files[0].text, files[0].name, job.columns, excluded);
        if (table) names = analysesFor(table.value);
        hasPlaces = table.value.column("target_x").has_value();
        hasTasks = table.value.column(trialColumns::task).has_value();
        return true;
    };
    readStudyFiles(job, inspect);
    std::string words;
    for (const std::string& name : names) {
        if (name == requested.name ||
            (requested.kind == Analysis::Kind::fit && name == "levels" && !hasTasks) ||
            (requested.name == "icons" && name == "confusion") ||
            (requested.name == "places" && name == "resolution" && hasPlaces))
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
    if (!report.error.empty()) report.error += otherKindText(*found, job);
    return report;
}

} // namespace physvib
