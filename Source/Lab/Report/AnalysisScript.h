// SPDX-License-Identifier: MIT
// analysis.R chooses and runs the statistical tests of a study; no other code tests hypotheses. It reads the
// tables of a report. This file also exports trials as a BIDS dataset.
#pragma once
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace physvib {

/// The script beside a report's tables, and what it writes: a line per figure.
inline constexpr const char *analysisScriptName = "analysis.R", *notebookName = "analysis.qmd";
inline constexpr const char* testsTable = "tests.csv";
/// Of stimuli in pairs: mean scores as a matrix, and a map of them.
inline constexpr const char *pairsTable = "similarity.csv", *mapTable = "mds.csv";

/// Files by name.
using StudyFiles = std::map<std::string, std::string>;

/// Runs the script among the files of a report, and returns what it wrote, or one line why it could not.
/// Without files (R is not there) the page says what to install.
using ScriptRunner = std::function<Result<StudyFiles>(const StudyFiles&)>;

/// The script. `study`: what it is of, one line. Equal input gives equal bytes. Any thread (allocates).
/// `points`: the scales whose scores are ranks. `half`: what the page calls a function's level of a half.
/// `isWithin`: everybody was to have each condition, whoever has estimates.
std::string analysisScript(const std::string& study, const std::vector<std::string>& scales,
                           const std::vector<std::string>& points = {}, const std::string& half = {},
                           bool isWithin = false);

/// A notebook of its steps, for Quarto or R Markdown. Any thread (allocates).
std::string analysisNotebook(const std::string& study);

/// Names of the tests in testsTable, each once. Any thread (allocates).
std::vector<std::string> testsIn(const std::string& table);

/// Why the file there must not be replaced by a new script or notebook: it is none of ours, or was edited.
/// Empty if it may be. Message thread only.
std::string keptScriptFault(const std::filesystem::path& path);

// Trials as a dataset of the Brain Imaging Data Structure (BIDS 1.8, without imaging), in memory.

/// Description of a dataset.
struct BidsWords {
    std::string name, task;                      ///< of the study; the task has the protocol's name
    std::string version;                         ///< of the program
    std::map<std::string, std::string> source{}; ///< further facts, as keys and values
    bool isSimulated = false;
    std::map<std::string, std::string> columns{}; ///< what the scales of the protocol mean
};

/// Paths and contents of the dataset's files: dataset_description.json, participants.tsv,
/// sub-CODE/beh/sub-CODE_task-NAME_beh.tsv, and descriptions of their columns. Precondition: `trials` has a
/// column `participant`. Codes that differ only in hyphens get a number. Any thread (allocates).
std::map<std::string, std::string> bidsDataset(const CsvTable& trials, const BidsWords& words);

/// What a column of our own trial files means. Any thread (allocates).
std::string columnMeaning(std::string_view column);

} // namespace physvib
