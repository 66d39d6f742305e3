// SPDX-License-Identifier: MIT
// List of all analyses, and selection of those that fit a table.
#include "Lab/Analysis/Analysis.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>
#include <set>

namespace physvib {
namespace {

constexpr Analysis analyses[] = {
    {Analysis::Kind::results, "confusion",
     "stimulus,response per trial: percent correct and information transfer", analyseConfusion},
    {Analysis::Kind::results, "resolution",
     "pointing responses: normals, likelihood map, percent counts, perceptual resolution", analyseResolution},
    {Analysis::Kind::results, "places",
     "pointing at targets anywhere: constant and variable error, distance, gain", analysePlaces},
    {Analysis::Kind::results, "percent-counts", "percent counts: the largest grid that merging makes of them",
     analysePercentCounts},
    {Analysis::Kind::results, "choices", "forced choices: shares of the alternatives", analyseChoices},
    {Analysis::Kind::results, "ratings", "slider ratings: means by condition", analyseRatings},
    {Analysis::Kind::results, "levels",
     "staircases, QUEST+, adjustments and magnitude estimations: thresholds and means", analyseLevels},
    {Analysis::Kind::results, "icons", "stimulus,response per trial: the patterns that are confused least",
     analyseIcons},
    {Analysis::Kind::fit, "psychometric",
     "psychometric functions of each participant, thresholds and JNDs over participants",
     analysePsychometric},
    {Analysis::Kind::fit, "power-law", "Stevens' exponent of magnitude estimations", analysePowerLaw},
};

static_assert(std::ranges::all_of(studyTasks,
                                  [](const auto& task) {
                                      return task.analysis.empty() ||
                                             std::ranges::find(analyses, task.analysis, &Analysis::name) !=
                                                 std::end(analyses);
                                  }),
              "every task's analysis is one of these");

} // namespace

std::span<const Analysis> allAnalyses() noexcept { return analyses; }

std::vector<std::string> analysesFor(const CsvTable& table) {
    std::set<std::string> found;
    const auto has = [&](std::string_view column) { return table.column(column).has_value(); };
    if (const auto task = table.column(trialColumns::task)) {
        const auto phase = table.column(trialColumns::phase), correct = table.column("correct"),
                   level = table.column("level_db");
        for (const CsvRow& row : table.rows) {
            const StudyTaskDescription* const did = studyTaskNamed(row.cells[*task]);
            if (did == nullptr) continue;
            const bool isTraining = phase && row.cells[*phase] == trialColumns::training;
            const bool isAdapted = did->answer == AnswerKind::choice && correct &&
                                   !row.cells[*correct].empty() && !(level && row.cells[*level].empty());
            if (did->answer == AnswerKind::level || (isAdapted && !isTraining))
                found.insert("levels"); // matches before a study stand for themselves
            else if (!isTraining && !isAdapted)
                found.emplace(did->analysis);
        }
    } else {
        if (has("stimulus") && has("response")) found.insert("confusion");
        const bool isGrid = has("target_column") && (has("target_row") || !has("target_x"));
        if (isGrid && has("x"))
            found.insert("resolution");
        else if (has("target_x") && has("x"))
            found.insert("places");
        if (has("c1")) found.insert("percent-counts");
        if (has("choice")) found.insert("choices");
        if ((has("value") && has("stimulus")) || (has("level_db") && has("correct"))) found.insert("levels");
        const bool hasScale =
            std::ranges::any_of(table.columns, [](const auto& column) { return !trialColumns::has(column); });
        if (found.empty() && has("participant") && (has("stimulus") || has("condition") || has("group")) &&
            hasScale)
            found.insert("ratings");
    }
    std::vector<std::string> names;
    for (const Analysis& analysis : analyses)
        if (found.contains(std::string{analysis.name})) names.emplace_back(analysis.name);
    return names;
}

namespace {

/// Of a table that an analysis rejected, the call that reads its trials; empty if that is unknown, or the
/// kind was right and the error is another.
std::string otherKindWords(const Analysis& asked, const AnalysisJob& job) {
    if (job.files.empty() || job.made != nullptr) return {};
    std::vector<std::string> names;
    bool hasPlaces = false;
    const auto look = [&](const std::vector<NamedText>& files) -> Result<bool> {
        auto table = readCsvTable(files[0].text, files[0].name, CsvHeader::loose);
        std::size_t leftOut = 0;
        if (table && takeColumns(table.value, job.columns, leftOut).empty()) names = analysesFor(table.value);
        hasPlaces = table.value.column("target_x").has_value();
        return true;
    };
    readStudyFiles(job, look);
    std::string words;
    for (const std::string& name : names) {
        if (name == asked.name || (asked.kind == Analysis::Kind::fit && name == "levels") ||
            (asked.name == "icons" && name == "confusion") ||
            (asked.name == "places" && name == "resolution" && hasPlaces))
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
    AnalysisReport report = found->run(job);
    if (!report.error.empty()) report.error += otherKindWords(*found, job);
    return report;
}

} // namespace physvib
