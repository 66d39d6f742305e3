// SPDX-License-Identifier: MIT
// Interface of the analyses of study trials: options and results.
#pragma once
#include "Lab/Analysis/AnalysisFiles.h"
#include "Lab/Statistics/Psychometric.h"
#include "Lab/Study/PercentCounts.h"
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Input files, options and output files; each analysis uses some of them.
struct AnalysisJob : StudySources {
    int tolerance = 0;                                 ///< confusion: grid steps that still count as correct
    double thresholdPercent = defaultPercentThreshold; ///< resolution, percent-counts: threshold of a cell
    std::size_t meanings = 8;                          ///< icons: number of meanings
    std::string picturePath, exportPath, countsPath;   ///< output files; empty: none
    std::string participantsPath; ///< confusion: output file with one row per participant
    // Fits to each participant's trials:
    std::string level, measure; ///< columns; empty: those of our own files
    PsychometricModel model{};

    bool operator==(const AnalysisJob&) const = default;
};

/// Result of an analysis.
struct AnalysisReport {
    std::string error;                             ///< one line; if set, only `words` may be set too
    bool isSimulated = false;                      ///< trials are of a simulated observer
    std::vector<std::string> warnings{};           ///< one line each
    std::string words{};                           ///< text result, in lines
    std::function<std::string()> picture{};        ///< SVG, watermarked if simulated; empty: none
    std::string table{}, counts{}, participants{}; ///< CSV
};

/// Names of the analyses that fit a table: for a trial file by its tasks, else by its columns. Any thread.
std::vector<std::string> analysesFor(const CsvTable& table);

/// Runs the analysis with that name, one of allAnalyses(). Message thread only.
AnalysisReport analyse(const std::string& name, const AnalysisJob& options);

/// Entry of the list of all analyses.
struct Analysis {
    enum class Kind { results, fit } kind; ///< of trials, or fitted to each participant's trials
    std::string_view name;
    const char* purpose;
    AnalysisReport (*run)(const AnalysisJob&);
};

/// Any thread.
std::span<const Analysis> allAnalyses() noexcept;

} // namespace physvib
