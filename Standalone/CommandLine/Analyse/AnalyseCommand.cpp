// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib analyse`: options of each analysis, and running it; the option `--columns`.
#include "CommandLine/Command.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Lab/Analysis/Analysis.h"
#include <algorithm>

namespace physvib {

void declareColumns(OptionTable& command, std::vector<std::string>& columnNames) {
    command
        .add("--columns", columnNames,
             "of another program's table: what it calls our columns, e.g. "
             "participant=subject,response=key_resp.keys")
        .as("NAME=COLUMN[,...]")
        .separated(static_cast<int>(limits::maxTableColumns));
}

namespace {

struct AnalyseOptions {
    AnalysisJob job;
    std::vector<std::string> columnNames; ///< as NAME=COLUMN, before parsing
};

void declareResultOptions(OptionTable& command, AnalysisJob& o) {
    const std::string name = command.name();
    const bool hasGridCells = name == "resolution" || name == "percent-counts";
    if (name == "confusion" || name == "icons")
        command.add("--tolerance", o.tolerance, "grid steps (rows + columns) that still count as correct")
            .in(0, 1000);
    if (hasGridCells)
        command.add("--threshold", o.thresholdPercent, "percent count that a cell must reach, inclusive")
            .in(0.0, 100.0);
    if (name == "resolution")
        command.add("--counts", o.countsPath, "the percent counts").outputFile("FILE.csv");
    if (name == "icons")
        command.add("--meanings", o.meanings, "how many meanings the icons shall have")
            .in(std::size_t{2}, std::size_t{1000});
    if (name == "confusion")
        command
            .add("--participants", o.participantsPath,
                 "percent correct and IT of each participant and condition")
            .outputFile("FILE.csv");
}

void declareFitOptions(OptionTable& command, AnalysisJob& o) {
    const bool isPsychometric = command.name() == "psychometric";
    command
        .add("--level", o.level,
             isPsychometric ? "column of levels (level_db)"
                            : "column of levels > 0, or word of the stimulus (stimulus)")
        .as("COLUMN");
    command
        .add("--measure", o.measure,
             isPsychometric ? "column of 1 and 0 (correct)" : "column of magnitudes (value)")
        .as("COLUMN");
    command.add("--picture", o.picturePath, "what was answered and the function, of the first condition")
        .outputFileNamed("FILE.svg");
    if (!isPsychometric) return;
    std::vector<std::pair<std::string, int>> shapes;
    for (std::size_t i = 0; i < psychometricShapeNames.size(); ++i)
        shapes.emplace_back(psychometricShapeNames[i], static_cast<int>(i));
    command
        .addRow(
            "--shape", [&o](int shape) { o.model.shape = static_cast<PsychometricShape>(shape); },
            "of the function (logistic)")
        .numbered(shapes)
        .as("logistic|normal|weibull");
    command
        .add("--guess", o.model.guess,
             "share of right answers without a percept: 1 / alternatives; 0 of stronger or weaker")
        .in(0.0, 0.9);
    command
        .add("--lapse", o.model.lapseRateBound,
             "highest lapse rate fitted (--guess 0: at most 0.02); 0: none")
        .in(0.0, maxLapseRate);
}

OptionTable& declareCommonOptions(OptionTable& command, const Analysis& analysis, AnalysisJob& o) {
    OptionTable& analysisTable = command.addCommand(std::string{analysis.name}, analysis.purpose);
    analysisTable.add("files", o.files, "trials, or what the analysis is about; several are taken together")
        .required()
        .as("FILE.csv");
    analysisTable.add("--export", o.exportPath, "the result as a table for a statistics package")
        .outputFile("FILE.csv");
    return analysisTable;
}

void declareAnalyse(OptionTable& command, AnalyseOptions& o) {
    for (const Analysis& analysis : allAnalyses()) {
        OptionTable& analysisTable = declareCommonOptions(command, analysis, o.job);
        switch (analysis.kind) {
        case Analysis::Kind::fit: declareFitOptions(analysisTable, o.job); break;
        case Analysis::Kind::results:
            if (analysis.name != "places")
                analysisTable.add("--picture", o.job.picturePath, "the result to look at")
                    .outputFileNamed("FILE.svg");
            declareResultOptions(analysisTable, o.job);
        }
        declareColumns(analysisTable, o.columnNames);
    }
}

int runAnalyse(const OptionTable& command, AnalyseOptions& options) {
    auto columns = parseColumnNames(options.columnNames);
    if (!columns) return reportExit(exitUsage, "--columns: " + columns.error);
    AnalysisJob& o = options.job;
    o.columns = std::move(columns.value);
    const AnalysisReport report = analyse(command.called()->name(), o);
    for (const auto& warning : report.warnings) printWarning(warning);
    if (report.error.empty() || !report.text.empty()) printIfSimulated(report.isSimulated);
    std::cout << report.text;
    if (!report.error.empty()) return reportExit(exitFailed, report.error);
    return writeStudyFiles({{o.exportPath, report.table},
                            {o.countsPath, report.counts},
                            {o.participantsPath, report.participants},
                            {o.picturePath, report.picture}});
}

} // namespace

Command analyseCommand() {
    return makeCommand("analyse", "what the trials of a study say", declareAnalyse, runAnalyse);
}

} // namespace physvib
