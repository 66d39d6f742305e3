// SPDX-License-Identifier: GPL-3.0-or-later
// Options of the analyses, and which of them was asked for.
#include "CommandLine/Analyse/AnalyseCommand.h"
#include "CommandLine/Command.h"
#include "CommandLine/Analyse/AnalyseFits.h"
#include "CommandLine/Analyse/AnalyseGrids.h"
#include "CommandLine/Analyse/AnalyseLabels.h"
#include "CommandLine/Analyse/AnalyseTests.h"
#include "CommandLine/Analyse/AnalyseVotes.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Files/TrialColumns.h"
#include "Study/StudyTasks.h"
#include <algorithm>
#include <set>
#include <span>

namespace physvib {
namespace {

struct Analysis {
    std::string_view name;
    const char* purpose;
    AnalysisReport (*run)(const AnalyseOptions&);
};

constexpr Analysis analyses[] = {
    {"confusion", "stimulus,response per trial: percent correct and information transfer", analyseConfusion},
    {"resolution", "pointing responses: normals, likelihood map, percent counts, perceptual resolution", analyseResolution},
    {"percent-counts", "percent counts: the largest grid that merging makes of them", analysePercentCounts},
    {"choices", "forced choices: shares of the alternatives", analyseChoices},
    {"ratings", "slider ratings: means by condition", analyseRatings},
    {"levels", "staircases, QUEST+, adjustments and magnitude estimations: thresholds and means", analyseLevels},
    {"icons", "stimulus,response per trial: the patterns that are confused least", analyseIcons},
};

static_assert(std::ranges::all_of(studyTasks, [](const auto& task) { return task.analysis.empty() || std::ranges::find(analyses, task.analysis, &Analysis::name) != std::end(analyses); }),
              "every task's analysis is one of these");

constexpr Analysis testsOverParticipants[] = {
    {"anova", "analysis of variance with repeated measures", analyseAnova},
    {"friedman", "levels of a within-factor, by ranks", analyseFriedman},
    {"wilcoxon", "two levels of a within-factor, by signed ranks", analyseWilcoxon},
    {"mann-whitney", "two groups, by ranks", analyseMannWhitney},
    {"kruskal-wallis", "two or more groups, by ranks", analyseKruskalWallis},
    {"shapiro", "whether values may be normal (Shapiro-Wilk)", analyseShapiro},
    {"pairs", "every two levels, corrected for their number", analysePairs},
};

void declareOwn(OptionTable& command, std::string_view name, AnalyseOptions& o) {
    const bool isGrid = name == "resolution" || name == "percent-counts";
    if (name == "confusion" || name == "icons")
        command.add("--tolerance", o.tolerance, "grid steps (rows + columns) that still count as correct")
            .in(0, 1000);
    if (isGrid)
        command.add("--threshold", o.thresholdPercent, "percent count that a cell must reach, inclusive")
            .in(0.0, 100.0);
    if (name == "resolution") command.add("--counts", o.countsPath, "the percent counts").written("FILE.csv");
    if (name == "icons")
        command.add("--meanings", o.meanings, "how many meanings the icons shall have")
            .in(std::size_t{2}, std::size_t{1000});
    if (name == "confusion")
        command.add("--participants", o.participantsPath, "percent correct and IT of each participant and condition").written("FILE.csv");
}

constexpr Analysis fits[] = {
    {"psychometric", "psychometric functions of each participant, thresholds and JNDs over participants", analysePsychometric},
    {"power-law", "Stevens' exponent of magnitude estimations", analysePowerLaw},
};

/// Of any kind; none of that name.
template <class Is>
const Analysis* analysisThat(Is is) {
    for (const auto kind : std::initializer_list<std::span<const Analysis>>{analyses, testsOverParticipants, fits})
        if (const auto found = std::ranges::find_if(kind, is); found != kind.end()) return &*found;
    return nullptr;
}

OptionTable& declare(OptionTable& command, const Analysis& analysis, AnalyseOptions& o) {
    OptionTable& own = command.addCommand(std::string{analysis.name}, analysis.purpose);
    own.add("files", o.files, "trials, or what the analysis is about; several are taken together").required().as("FILE.csv");
    own.add("--export", o.exportPath, "the result as a table for a statistics package").written("FILE.csv");
    return own;
}

} // namespace

void declareColumns(OptionTable& command, AnalyseOptions& o) {
    command.add("--columns", o.columnWords, "of another program's table: what it calls our columns, e.g. participant=subject,response=key_resp.keys").as("NAME=COLUMN[,...]").listed(static_cast<int>(limits::maxTableColumns));
}

void declareAnalyse(OptionTable& command, AnalyseOptions& o) {
    for (const Analysis& analysis : analyses) {
        OptionTable& own = declare(command, analysis, o);
        own.add("--picture", o.picturePath, "the result to look at").written("FILE.png");
        declareOwn(own, analysis.name, o);
        declareColumns(own, o);
    }
    for (const Analysis& test : testsOverParticipants) declareTest(declare(command, test, o), o);
    for (const Analysis& fit : fits) {
        OptionTable& own = declare(command, fit, o);
        declareFit(own, o);
        declareColumns(own, o);
    }
}

std::vector<std::string> analysesFor(const CsvTable& table) {
    std::set<std::string> found;
    const auto has = [&](std::string_view column) { return table.column(column).has_value(); };
    if (const auto task = table.column(trialColumns::task)) {
        const auto phase = table.column(trialColumns::phase), correct = table.column("correct");
        for (const CsvRow& row : table.rows) {
            const StudyTaskDescription* const did = studyTaskNamed(row.cells[*task]);
            if (did == nullptr) continue;
            const bool isTraining = phase && row.cells[*phase] == trialColumns::training;
            const bool isAdapted = did->answer == AnswerKind::choice && correct && !row.cells[*correct].empty();
            if (isAdapted || did->analysis == "levels") found.insert("levels"); // of trainings, too
            else if (!isTraining) found.emplace(did->analysis);
        }
    } else {
        if (has("stimulus") && has("response")) found.insert("confusion");
        if (has("target_column") && has("x")) found.insert("resolution");
        if (has("c1")) found.insert("percent-counts");
        if (has("choice")) found.insert("choices");
        if ((has("value") && has("stimulus")) || (has("level_db") && has("correct"))) found.insert("levels");
        const bool hasScale = std::ranges::any_of(table.columns, [](const auto& column) { return !trialColumns::has(column); });
        if (found.empty() && has("participant") && (has("stimulus") || has("condition")) && hasScale) found.insert("ratings");
    }
    std::vector<std::string> names;
    for (const Analysis& analysis : analyses)
        if (found.contains(std::string{analysis.name})) names.emplace_back(analysis.name);
    return names;
}

AnalysisReport analyse(const std::string& name, const AnalyseOptions& options) {
    const Analysis* const found = analysisThat([&](const Analysis& a) { return a.name == name; });
    return found ? found->run(options) : AnalysisReport{"no analysis " + inQuotes(name)};
}

int runAnalyse(const OptionTable& command, AnalyseOptions& o) {
    auto columns = parseColumnNames(o.columnWords);
    if (!columns) return leave(exitUsage, "--columns: " + columns.error);
    o.columns = std::move(columns.value);
    const Analysis* const asked = analysisThat([&](const Analysis& a) { return command.isCalled(std::string{a.name}); });
    if (!asked) return leave(exitUsage, "analyse: expected a kind of analysis (see physvib analyse --help)");
    const AnalysisReport report = asked->run(o);
    for (const auto& words : report.warnings) warn(words);
    if (report.error.empty() || !report.words.empty()) tellIfSimulated(report.isSimulated);
    std::cout << report.words;
    if (!report.error.empty()) return leave(exitFailed, report.error);
    return writeStudyFiles({{o.exportPath, report.table}, {o.countsPath, report.counts}, {o.participantsPath, report.participants}, {o.picturePath, report.picture}});
}

Command analyseCommand() { return commandOf("analyse", "what the trials of a study say", declareAnalyse, runAnalyse); }

} // namespace physvib
