// SPDX-License-Identifier: MIT
// Analyses of study trials: their list, options and results, and helpers that read files and write tables.
#pragma once
#include "Io/Disk/ReadFile.h"
#include "Io/Provenance.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Protocol.h"
#include "Lab/Study/Psychometric.h"
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace physvib {

/// A share as a percentage with one decimal, without the sign. Any thread.
inline std::string percentNumber(double share) { return fixedNumber(100.0 * share, 1); }

/// A cell as a page or terminal shows it: numbers have four significant digits. Any thread.
std::string displayCell(const std::string& cell);

/// Input files of an analysis.
struct StudySources {
    std::vector<std::string> files;
    std::vector<ColumnName> columns{}; ///< column mapping for tables of another program
    /// tables in memory by name, with our columns; used instead of files
    const std::map<std::string, std::string>* memoryTables = nullptr;
    bool operator==(const StudySources&) const = default;
};

/// Reads all files, then calls `reader` once with their texts.
template <class Reader>
auto readStudyFiles(const StudySources& sources, Reader reader, std::size_t maxBytes = limits::maxTableBytes)
    -> decltype(reader(std::vector<NamedText>{})) {
    std::vector<std::string> texts(sources.files.size());
    std::vector<NamedText> files;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const std::string& path = sources.files[i];
        if (sources.memoryTables)
            if (const auto found = sources.memoryTables->find(path); found != sources.memoryTables->end()) {
                files.push_back({found->second, path});
                continue;
            }
        auto text = readFile(path, maxBytes);
        if (!text) return Failure{text.error};
        texts[i] = std::move(text.value);
        files.push_back({texts[i], path, sources.columns});
    }
    return reader(files);
}

/// The number of a cell; nullopt for an empty cell.
inline std::optional<double> valueIf(bool isKnown, double number) {
    return isKnown ? std::optional{number} : std::nullopt;
}

/// CSV table for statistics packages, written cell by cell.
class ExportTable {
public:
    ExportTable(std::string_view kind, bool isSimulated, std::string_view header) {
        Provenance provenance{PHYSVIB_VERSION, {{"analysis", std::string(kind)}}};
        if (isSimulated) provenance.entries.emplace_back("observer", "simulated");
        text_ = provenanceComment(provenance);
        text_.append(header).append("\n");
    }
    ExportTable& cell(std::string_view words) {
        separate();
        appendCell(text_, words);
        return *this;
    }
    template <class Number>
    requires std::is_arithmetic_v<Number> ExportTable& cell(Number number) {
        separate();
        appendNumber(text_, number);
        return *this;
    }
    /// Appends a number, or an empty cell for nullopt.
    ExportTable& cell(const std::optional<double>& number) {
        return number ? cell(*number) : cell(std::string_view{});
    }
    template <class... Values>
    ExportTable& cells(const Values&... values) {
        return (cell(values), ...);
    }
    /// Writes the remaining cells of a row, and ends it.
    template <class... Values>
    void row(const Values&... values) {
        cells(values...).endRow();
    }
    void endRow() {
        text_ += '\n';
        isFirst_ = true;
    }
    const std::string& text() const { return text_; }

private:
    void separate() {
        if (!isFirst_) text_ += ',';
        isFirst_ = false;
    }
    std::string text_;
    bool isFirst_ = true;
};

/// Input files, options and output files; each analysis uses some of them.
struct AnalysisJob : StudySources {
    int tolerance = 0;                                 ///< confusion: grid steps that still count as correct
    double thresholdPercent = defaultPercentThreshold; ///< resolution, percent-counts: threshold of a cell
    std::size_t meanings = 8;                          ///< icons: number of meanings
    std::string picturePath, exportPath, countsPath;   ///< output files; empty: none
    std::string participantsPath; ///< confusion: output file with one row per participant
    // Fits to each participant's trials:
    std::string level, measure; ///< columns of levels and of answers; empty: those of our own files
    PsychometricModel model{};
    std::optional<Protocol> protocol{}; ///< protocol of the trials; none: a built-in one is looked up

    bool operator==(const AnalysisJob&) const = default;
};

/// Result of an analysis.
struct AnalysisReport {
    std::string error;                             ///< one line; if set, only `text` may be set too
    bool isSimulated = false;                      ///< trials are of a simulated observer
    std::vector<std::string> warnings{};           ///< one line each
    std::string text{};                            ///< text result, in lines
    std::string summary{};                         ///< CSV of what `text` shows; else `table` is shown
    std::function<std::string()> picture{};        ///< SVG, watermarked if simulated; empty: none
    std::string table{}, counts{}, participants{}; ///< CSV
};

/// Names of the analyses that fit a table: for a trial file by its tasks, else by its columns. Any thread.
std::vector<std::string> analysesFor(const CsvTable& table);

/// Runs the analysis with that name, one of allAnalyses(). Message thread only.
AnalysisReport analyse(const std::string& name, const AnalysisJob& options);

/// Entry of the list of all analyses.
struct Analysis {
    enum class Kind { results, fit }; ///< computed from all trials, or fitted to each participant's
    std::string_view name;
    const char *purpose, *columns; ///< columns: of its table
    AnalysisReport (*run)(const Analysis&, const AnalysisJob&);
    Kind kind = Kind::results;
};

/// The list of all analyses. Any thread.
std::span<const Analysis> allAnalyses() noexcept;

// Readers of trials, which return an error line if they fail, and the analyses of these trials. Analysis.cpp
// lists them. Message thread only.

/// Outputs of an analysis: `out` becomes the report's text, `table` its table.
struct AnalysisOutput {
    const AnalysisJob& job;
    AnalysisReport& report;
    std::ostream& out;
    ExportTable& table;
};

// Labels: confusion matrices, information transfer, icons.
Result<StudyData<IdentificationTrial>> readLabels(const AnalysisJob& job);
void analyseConfusion(const StudyData<IdentificationTrial>& data, const AnalysisOutput& output);
void analyseIcons(const StudyData<IdentificationTrial>& data, const AnalysisOutput& output);

// Places: perceptual resolution from pointing responses or percent counts, and pointing errors.
Result<StudyData<PlaceTrial>> readTargets(const AnalysisJob& job);
void analyseResolution(const StudyData<LocationTrial>& data, const AnalysisOutput& output);
void analysePlaces(const StudyData<PlaceTrial>& data, const AnalysisOutput& output);
void analysePercentCounts(const StudyData<PercentCounts>& data, const AnalysisOutput& output);

// Judgements and levels: forced choices, slider ratings, staircases, QUEST+, adjustments, magnitudes.
void analyseChoices(const StudyData<ChoiceTrial>& data, const AnalysisOutput& output);
void analyseRatings(const RatingData& data, const AnalysisOutput& output);
/// Sets the intervals of scales in points to 0, since their scores are ordinal. Any thread.
std::vector<RatingSummary> withoutOrdinalIntervals(std::vector<RatingSummary> summaries,
                                                   const AnalysisJob& job, const RatingData& data);
/// Reads levels without unfinished staircases and QUEST+ runs, if the protocol is known.
Result<StudyData<LevelTrial>> readFinishedLevels(const AnalysisJob& job);
void analyseLevels(const StudyData<LevelTrial>& data, const AnalysisOutput& output);

// Functions fitted to each participant's trials.
Result<StudyData<LevelAnswer>> readAnswers(const AnalysisJob& job);
Result<StudyData<LevelAnswer>> readMagnitudes(const AnalysisJob& job);
void analysePsychometric(const StudyData<LevelAnswer>& data, const AnalysisOutput& output);
void analysePowerLaw(const StudyData<LevelAnswer>& data, const AnalysisOutput& output);

} // namespace physvib
