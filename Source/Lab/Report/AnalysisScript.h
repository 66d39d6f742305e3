// SPDX-License-Identifier: MIT
// The tests of a study over participants, and analysis.R, which runs them: the only place of inference. C++
// says which tests there are; R alone computes (Lab/Script/analysis.R).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace physvib {

/// One test of the report's tables.
struct StudyTest {
    enum class Kind { anova, friedman, pairs, choices } kind = Kind::anova;
    std::string table;                 ///< file in the report's folder
    std::string measure{};             ///< its column of numbers; "choice=RM": 1 where the column says so
    std::vector<std::string> within{}; ///< factors that every participant has all levels of
    std::vector<std::string> where{};  ///< "method=quest": only rows that say so
    bool isOfRanks = false;            ///< pairs: signed ranks instead of t
    bool isBonferroni = false;         ///< pairs: instead of Holm's correction

    /// One line, for pages and plans. Any thread (allocates).
    std::string words() const;
    /// The call of the script's function.
    std::string call() const;
};

/// Name of the script beside a report's tables.
inline constexpr const char* analysisScriptName = "analysis.R";

/// The script. `study`: what it is of, one line. Equal input gives equal bytes. Any thread (allocates).
std::string analysisScript(const std::vector<StudyTest>& tests, const std::string& study);

/// Why the file there must not be replaced by a new script: it is not one of ours, or somebody has edited it.
/// Empty if it may be. Message thread only.
std::string keptScriptFault(const std::filesystem::path& path);

} // namespace physvib
