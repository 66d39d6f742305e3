// SPDX-License-Identifier: MIT
// Writes analysis.R, which reads the tables of a report, and chooses and runs the statistical tests of a
// study; no other code tests hypotheses. Exports trials as a BIDS dataset.
#pragma once
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace physvib {

/// File names of the script and the notebook beside a report's tables, and of the table of tests.
inline constexpr const char *analysisScriptName = "analysis.R", *notebookName = "analysis.qmd";
inline constexpr const char* testsTable = "tests.csv";
/// Tables of paired stimuli: mean scores as a matrix, and their map by multidimensional scaling.
inline constexpr const char *pairsTable = "similarity.csv", *mapTable = "mds.csv";

/// Contents of files by their names.
using StudyFiles = std::map<std::string, std::string>;

/// Runs the script among the files of a report, and returns the files it wrote, or an error line.
/// An empty result means that R is not installed.
using ScriptRunner = std::function<Result<StudyFiles>(const StudyFiles&)>;

/// The script's text. `study`: one line that names it. Equal input gives equal bytes. Any thread (allocates).
/// `ordinalScales`: scales whose scores are ranks. `midpointName`: name of the level at which a function is
/// one half. `isWithinSubjects`: each participant was to have every condition, even if some lack estimates.
std::string analysisScript(const std::string& study, const std::vector<std::string>& scales,
                           const std::vector<std::string>& ordinalScales = {},
                           const std::string& midpointName = {}, bool isWithinSubjects = false);

/// A notebook of its steps, for Quarto or R Markdown. Any thread (allocates).
std::string analysisNotebook(const std::string& study);

/// Names of the tests in testsTable, each once. Any thread (allocates).
std::vector<std::string> testNames(const std::string& table);

/// An error if the file at `path` is no script or notebook that PhysVib wrote, or was edited since.
/// Empty if it may be replaced. Message thread only.
std::string scriptOverwriteError(const std::filesystem::path& path);

// Trials as a dataset of the Brain Imaging Data Structure (BIDS 1.8, without imaging), in memory.

/// Description of a dataset.
struct BidsDescription {
    std::string name, task;                      ///< name of the study, and of its task: the protocol's name
    std::string version;                         ///< version of this program
    std::map<std::string, std::string> source{}; ///< further facts, as keys and values
    bool isSimulated = false;
    std::map<std::string, std::string> columns{}; ///< what the scales of the protocol mean
};

/// Paths and contents of the dataset's files: dataset_description.json, participants.tsv,
/// sub-CODE/beh/sub-CODE_task-NAME_beh.tsv, and descriptions of their columns. Precondition: `trials` has a
/// column `participant`. Codes that differ only in hyphens get a number. Any thread (allocates).
std::map<std::string, std::string> bidsDataset(const CsvTable& trials, const BidsDescription& dataset);

/// What a column of our own trial files means. Any thread (allocates).
std::string columnMeaning(std::string_view column);

} // namespace physvib
