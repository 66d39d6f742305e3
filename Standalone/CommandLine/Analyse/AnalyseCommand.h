// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib analyse`: what the trials of a study say.
#pragma once
#include "CommandLine/Study/StudyOutput.h"
#include "Files/Text/CsvTable.h"
#include "Study/PercentCounts.h"
#include "Study/Statistics/Pairs.h"
#include "Study/Statistics/Psychometric.h"
#include "Study/Statistics/TestReport.h"
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

class OptionTable;

/// As given on the command line; each kind of analysis uses some of them.
struct AnalyseOptions : StudySources {
    std::vector<std::string> columnWords;                ///< as NAME=COLUMN, before they are columns
    int tolerance = 0;                                   ///< confusion: grid steps that still count as correct
    double thresholdPercent = defaultPercentThreshold;   ///< resolution, percent-counts
    std::size_t meanings = 8;                            ///< icons
    std::string picturePath, exportPath, countsPath;     ///< empty: not wanted
    std::string participantsPath;                        ///< confusion: a row per participant
    // Tests over participants:
    std::string measure, between, participant;
    std::vector<std::string> within, where;
    std::optional<Correction> correction;
    PairTest pairTest = PairTest::student;
    bool usesAlignedRanks = false;
    // Fits to each participant's trials:
    std::string level;
    PsychometricShape shape = PsychometricShape::logistic;
    double guess = 0.5;
};

/// What an analysis has found.
struct AnalysisReport {
    std::string error;                    ///< one line; then only `words` may hold something
    bool isSimulated = false;             ///< a simulated observer answered, not a person
    std::vector<std::string> warnings{};  ///< a line each
    std::string words{};                  ///< its figures, in lines
    std::function<std::string()> picture{}; ///< PNG bytes, watermarked if simulated; M, while JUCE is initialised
    std::string table{}, counts{}, participants{}; ///< CSV
    std::vector<TestLine> lines{};                 ///< of a test
};

/// The analyses that fit a table, by their names: of a trial file by the tasks in it, else by its columns. Any thread.
std::vector<std::string> analysesFor(const CsvTable& table);

/// The analysis of that name, one of analysesFor's. M only.
AnalysisReport analyse(const std::string& name, const AnalyseOptions& options);

/// Declares the analyses as subcommands of `command`.
void declareAnalyse(OptionTable& command, AnalyseOptions& options);

/// `--columns`, for those who read other programs' tables.
void declareColumns(OptionTable& command, AnalyseOptions& options);

/// Runs the one that `command` has parsed; the code to leave with.
int runAnalyse(const OptionTable& command, AnalyseOptions& options);

} // namespace physvib
