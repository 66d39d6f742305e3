// SPDX-License-Identifier: MIT
// An analysis of the trials of a study: what is asked, and what is found.
#pragma once
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Statistics/Pairs.h"
#include "Lab/Statistics/Psychometric.h"
#include "Lab/Statistics/TestReport.h"
#include "Lab/Study/PercentCounts.h"
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// What is asked of which files, and what is written; each kind of analysis uses some of it.
struct AnalysisJob : StudySources {
    int tolerance = 0;                                 ///< confusion: grid steps that still count as correct
    double thresholdPercent = defaultPercentThreshold; ///< resolution, percent-counts
    std::size_t meanings = 8;                          ///< icons
    std::string picturePath, exportPath, countsPath;   ///< empty: not wanted
    std::string participantsPath;                      ///< confusion: a row per participant
    // Tests over participants:
    std::string measure, between, participant;
    std::vector<std::string> within, where;
    std::optional<Correction> correction;
    PairTest pairTest = PairTest::student;
    bool usesAlignedRanks = false;
    // Fits to each participant's trials:
    std::string level;
    PsychometricModel model{};

    bool operator==(const AnalysisJob&) const = default;
};

/// What an analysis has found.
struct AnalysisReport {
    std::string error;                             ///< one line; then only `words` may hold something
    bool isSimulated = false;                      ///< a simulated observer answered, not a person
    std::vector<std::string> warnings{};           ///< a line each
    std::string words{};                           ///< its figures, in lines
    std::function<std::string()> picture{};        ///< SVG, watermarked if simulated; empty: none
    std::string table{}, counts{}, participants{}; ///< CSV
    std::vector<TestLine> lines{};                 ///< of a test
};

/// The analyses that fit a table, by their names: of a trial file by the tasks in it, else by its columns.
/// Any thread.
std::vector<std::string> analysesFor(const CsvTable& table);

/// The analysis of that name, one of analysesFor's. M only.
AnalysisReport analyse(const std::string& name, const AnalysisJob& options);

/// A row of the list of all analyses.
struct Analysis {
    enum class Kind {
        results,
        test,
        fit
    } kind; ///< of trials, over participants, to each participant's trials
    std::string_view name;
    const char* purpose;
    AnalysisReport (*run)(const AnalysisJob&);
};

/// Any thread.
std::span<const Analysis> allAnalyses() noexcept;

} // namespace physvib
