// SPDX-License-Identifier: MIT
// analysis.R, which chooses and runs the tests of a study over participants: the only place of inference. It
// reads the tables of a report; C++ only says which columns are rating scales.
#pragma once
#include "Io/Result.h"
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

} // namespace physvib
